// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>
#include <selvedge/Sha256.h>

#include <openssl/evp.h>

#include <fstream>
#include <stdexcept>
#include <vector>

namespace selvedge {

struct Sha256::Implementation
{
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  ~Implementation() { EVP_MD_CTX_free(context); }
};

Sha256::Sha256() : m_implementation(std::make_unique<Implementation>())
{
  if (EVP_DigestInit_ex(m_implementation->context, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("this OpenSSL does not offer SHA-256");
}

Sha256::~Sha256() = default;

void Sha256::add(std::string_view bytes)
{
  EVP_DigestUpdate(m_implementation->context, bytes.data(), bytes.size());
}

std::string Sha256::digest()
{
  unsigned char bytes[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  EVP_DigestFinal_ex(m_implementation->context, bytes, &size);
  std::string text;
  for (unsigned int i = 0; i < size; ++i) {
    text += "0123456789abcdef"[bytes[i] / 16];
    text += "0123456789abcdef"[bytes[i] % 16];
  }
  return text;
}

std::string sha256_of_file(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw Input_error(path.string() + ": cannot be opened; check its permissions");
  Sha256 sha256;
  std::vector<char> buffer(1 << 16);
  while (file.read(buffer.data(), std::streamsize(buffer.size())) || file.gcount() > 0) {
    Cancellation_scope::check();
    sha256.add({buffer.data(), std::size_t(file.gcount())});
  }
  if (file.bad())
    throw Input_error(path.string() + ": cannot be read to its end; check the disk");
  return sha256.digest();
}

} // namespace selvedge
