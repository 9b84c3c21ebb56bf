// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "files/gzip.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>

#include <algorithm>
#include <new>
#include <utility>
#include <vector>

#include <zlib.h>

namespace selvedge::files {
namespace {

constexpr int s_gzip_window = 15 + 16;  // the largest window, and the head and foot of gzip
constexpr std::size_t s_most = 1 << 24; // bytes between two checks for cancellation; fits zlib's counters

// zlib reads through a pointer to bytes that it does not change.
Bytef* bytes_of(const char* data)
{
  return reinterpret_cast<Bytef*>(const_cast<char*>(data));
}

class Inflation
{
public:
  Inflation()
  {
    if (inflateInit2(&m_stream, s_gzip_window) != Z_OK)
      throw std::bad_alloc();
  }
  ~Inflation() { inflateEnd(&m_stream); }
  Inflation(const Inflation&) = delete;
  Inflation& operator=(const Inflation&) = delete;

  z_stream& stream() { return m_stream; }

private:
  z_stream m_stream = {};
};

} // namespace

std::string unpacked(std::string_view packed, const std::string& name)
{
  constexpr std::size_t most_times = 100, always = 1 << 16;
  if (packed.empty())
    return {};
  const std::size_t most = std::max(always, most_times * packed.size());
  if (packed.substr(0, 2) != "\x1f\x8b")
    throw Input_error(name + ": is not packed by gzip, as its name says; leave out .gz, or pack it again");
  Inflation inflation;
  z_stream& stream = inflation.stream();
  std::string contents;
  std::size_t read = 0, written = 0;
  for (bool is_ended = false;;) {
    Cancellation_scope::check();
    if (is_ended) {
      // A file may consist of several packed ones, one after another. Zeros are padding.
      const std::size_t next = std::min(packed.find_first_not_of('\0', read), packed.size());
      if (next == packed.size()) {
        contents.resize(written);
        return contents;
      }
      read = next;
      inflateReset(&stream);
    }
    if (written == contents.size())
      contents.resize(std::min(most + 1, std::max({2 * written, 4 * packed.size(), always})));
    stream.next_in = bytes_of(packed.data() + read);
    stream.avail_in = uInt(std::min(packed.size() - read, s_most));
    stream.next_out = bytes_of(contents.data() + written);
    stream.avail_out = uInt(std::min(contents.size() - written, s_most));
    const uInt in = stream.avail_in, out = stream.avail_out;
    const int status = inflate(&stream, Z_NO_FLUSH);
    read += in - stream.avail_in;
    written += out - stream.avail_out;
    is_ended = status == Z_STREAM_END;
    if (written > most)
      throw Input_error(name + ": its contents are more than " + std::to_string(most_times) +
                        " times as large as the file; if that is right, unpack it first");
    if (status == Z_MEM_ERROR)
      throw std::bad_alloc();
    if (status == Z_BUF_ERROR || (status == Z_OK && read == packed.size() && stream.avail_out != 0))
      throw Input_error(name + ": the packed file is truncated; copy or export it again");
    if (status != Z_OK && !is_ended)
      throw Input_error(name + ": the packed file is damaged; copy or export it again");
  }
}

struct Gzip_packer::Implementation
{
  z_stream stream = {};
  std::vector<char> buffer = std::vector<char>(1 << 16);
};

Gzip_packer::Gzip_packer(Sink sink)
    : m_sink(std::move(sink)), m_implementation(std::make_unique<Implementation>())
{
  constexpr int most_memory = 9;
  if (deflateInit2(&m_implementation->stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, s_gzip_window, most_memory,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
}

Gzip_packer::~Gzip_packer()
{
  deflateEnd(&m_implementation->stream);
}

void Gzip_packer::add(const char* data, std::size_t size)
{
  for (; size > s_most; data += s_most, size -= s_most)
    pack(data, s_most, false);
  pack(data, size, false);
}

void Gzip_packer::finish()
{
  pack(nullptr, 0, true);
}

void Gzip_packer::pack(const char* data, std::size_t size, bool is_last)
{
  auto& [stream, buffer] = *m_implementation;
  stream.next_in = bytes_of(data);
  stream.avail_in = uInt(size);
  do {
    Cancellation_scope::check();
    stream.next_out = bytes_of(buffer.data());
    stream.avail_out = uInt(buffer.size());
    deflate(&stream, is_last ? Z_FINISH : Z_NO_FLUSH);
    m_sink(buffer.data(), buffer.size() - stream.avail_out);
  } while (stream.avail_out == 0);
}

} // namespace selvedge::files
