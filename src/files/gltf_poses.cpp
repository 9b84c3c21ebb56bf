// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/gltf_poses.h>

#include "files/gltf_column_reader.h"
#include "files/gltf_document.h"
#include "files/humanoid.h"
#include "soup/gltf_transforms.h"

#include <selvedge/Cancellation_scope.h>
#include <selvedge/Error.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>

// Evaluates morph targets, animations and skins of the scene that a soup was read from. The reader has
// checked nodes, meshes and vertices; what the document says of animations and skins is checked here.

namespace selvedge {
namespace {

using Json = Gltf_scene::Json;
using Matrix = Gltf_scene::Matrix;
using files::member;

// The rows of an accessor as numbers.
struct Number_rows
{
  std::size_t components = 1;
  std::vector<double> numbers;

  std::size_t size() const { return numbers.size() / components; }
};

enum class Path : unsigned char { translation, rotation, scale, weights };
enum class Interpolation : unsigned char { step, linear, cubic };

// What moves one property of one node.
struct Channel
{
  Index node = 0;
  Path path = Path::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<double> times;
  std::vector<double> values; // one after another; in a cubic spline with the tangents before and after each
  std::size_t size = 0;       // numbers in a value

  using Value = std::vector<double>;

  Value value(std::size_t key) const { return part(key, interpolation == Interpolation::cubic ? 1 : 0); }

  // Of a cubic spline: its tangent before the key, its value, its tangent after the key.
  Value part(std::size_t key, std::size_t which) const
  {
    const std::size_t parts = interpolation == Interpolation::cubic ? 3 : 1;
    const auto first = values.begin() + std::ptrdiff_t((key * parts + which) * size);
    return {first, first + std::ptrdiff_t(size)};
  }
};

Channel::Value sum(double a, const Channel::Value& x, double b, const Channel::Value& y)
{
  Channel::Value result(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    result[i] = a * x[i] + b * y[i];
  return result;
}

double dot(const Channel::Value& a, const Channel::Value& b)
{
  double result = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    result += a[i] * b[i];
  return result;
}

Channel::Value slerp(const Channel::Value& from, const Channel::Value& to, double share)
{
  const double cosine = dot(from, to), side = cosine < 0 ? -1 : 1;
  const double angle = std::acos(std::min(std::abs(cosine), 1.0)), sine = std::sin(angle);
  constexpr double nearly_none = 1e-6; // below it, both formulas agree to the last bits
  if (sine < nearly_none)
    return sum(1 - share, from, side * share, to);
  return sum(std::sin(angle * (1 - share)) / sine, from, side * std::sin(angle * share) / sine, to);
}

Channel::Value spline(const Channel& channel, std::size_t key, double span, double t)
{
  const double t2 = t * t, t3 = t2 * t;
  const Channel::Value start =
      sum(2 * t3 - 3 * t2 + 1, channel.part(key, 1), span * (t3 - 2 * t2 + t), channel.part(key, 2));
  const Channel::Value end =
      sum(-2 * t3 + 3 * t2, channel.part(key + 1, 1), span * (t3 - t2), channel.part(key + 1, 0));
  return sum(1, start, 1, end);
}

Channel::Value value_at(const Channel& channel, double time)
{
  const auto next = std::upper_bound(channel.times.begin(), channel.times.end(), time);
  const std::size_t key = next == channel.times.begin() ? 0 : std::size_t(next - channel.times.begin()) - 1;
  const bool is_at_key = next == channel.times.begin() || next == channel.times.end() || time == *(next - 1);
  const bool is_rotation = channel.path == Path::rotation;
  Channel::Value result = channel.value(key);
  if (!is_at_key && channel.interpolation != Interpolation::step) {
    const double span = *next - channel.times[key], share = (time - channel.times[key]) / span;
    const auto linear = [&] {
      const Channel::Value to = channel.value(key + 1);
      return is_rotation ? slerp(result, to, share) : sum(1 - share, result, share, to);
    };
    result = channel.interpolation == Interpolation::linear ? linear() : spline(channel, key, span, share);
  }
  if (is_rotation && channel.interpolation == Interpolation::cubic) {
    const double length = std::sqrt(dot(result, result));
    for (double& number : result)
      number /= length;
  }
  return result;
}

struct Skin
{
  std::vector<Index> joints; // nodes
  std::vector<Matrix> inverse_bind;
};

struct Influence
{
  std::size_t joint; // its place in the skin
  double weight;
};

// What a pose changes of the scene.
struct Changes
{
  std::map<Index, tinygltf::Node> nodes;                                    // with transforms
  std::map<Index, Channel::Value> weights;                                  // of nodes
  std::vector<files::Bone_turn> turns;                                      // one after another
  std::optional<std::vector<std::vector<std::size_t>>> targets_at_one = {}; // of instances, in the bind pose
};

class Gltf_poser
{
public:
  Gltf_poser(const Triangle_soup& mesh, const std::string& name) : m_mesh(mesh), m_name(name)
  {
    if (!mesh.scene)
      fail("is no glTF file, and only these have morph targets, animations and skeletons of their own");
  }

  std::vector<Pose> morphs()
  {
    // By name, in the order in which they first occur: for every instance the targets of this name.
    std::vector<std::pair<std::string, std::vector<std::vector<std::size_t>>>> targets;
    std::map<std::string, std::size_t> numbers;
    for (std::size_t i = 0; i < scene().instances.size(); ++i) {
      const std::vector<std::string> names = target_names(i);
      for (std::size_t target = 0; target < names.size(); ++target) {
        const auto [found, is_new] = numbers.emplace(names[target], targets.size());
        if (is_new)
          targets.push_back({names[target], std::vector<std::vector<std::size_t>>(scene().instances.size())});
        targets[found->second].second[i].push_back(target);
      }
    }
    if (targets.empty())
      fail("has no morph targets that could be poses; leave out the option that asks for them");
    limit(targets.size(), "morph them by another program, and give the files as poses");
    std::vector<Pose> result;
    for (const auto& [target, of_instances] : targets) {
      Changes changes;
      changes.targets_at_one = of_instances;
      result.push_back({unique(file_name(target)), points(changes)});
    }
    return result;
  }

  std::vector<Pose> animations(const std::string& wanted, std::size_t every)
  {
    const Json& list = member(scene().document, "animations");
    std::vector<std::string> labels;
    std::vector<Pose> result;
    std::vector<std::pair<std::size_t, std::string>> chosen;
    for (std::size_t i = 0; i < list.size(); ++i) {
      std::string label = list[i].value("name", "");
      if (label.empty())
        label = "animation_" + std::to_string(i);
      if (wanted == "all" || wanted == label)
        chosen.emplace_back(i, unique(file_name(label)));
      labels.push_back("'" + label + "'");
    }
    if (labels.empty())
      fail("has no animations that could give poses; leave out the option that asks for them");
    if (chosen.empty()) {
      std::string known;
      for (const std::string& label : labels)
        known += (known.empty() ? "" : ", ") + label;
      fail("has no animation '" + wanted + "'; it has " + known);
    }
    read_skins();
    for (const auto& [number, label] : chosen) {
      const std::string place = "animation " + std::to_string(number);
      const std::vector<Channel> channels = channels_of(list[number], place);
      std::set<double> times;
      for (const Channel& channel : channels)
        times.insert(channel.times.begin(), channel.times.end());
      limit(result.size() + (times.size() + every - 1) / every, "take fewer of their keyframes");
      std::size_t key = 0;
      for (const double time : times)
        if (key++ % every == 0)
          result.push_back(
              {label + "_" + std::to_string(key), points(changes_at(channels, time)), float(time)});
    }
    if (result.empty())
      fail("its animation '" + wanted + "' moves no node");
    return result;
  }

  std::vector<Pose> humanoids()
  {
    const files::Humanoid figure = files::find_humanoid(scene());
    std::string missing;
    for (const std::string& bone : figure.missing)
      missing += (missing.empty() ? "" : ", ") + bone;
    if (!missing.empty())
      fail("its skeleton is not known to be that of a human figure: there is no " + missing +
           "; name the joints as VRM or Mixamo does, or give poses by --animation");
    read_skins();
    if (m_skins.empty())
      fail("has no skin that a figure could move");
    const std::vector<files::Posture> postures = files::humanoid_postures(figure, to_world({}));
    if (postures.empty())
      fail("both legs of its figure begin at one place; correct nodes " +
           std::to_string(figure.legs[0].front()) + " and " + std::to_string(figure.legs[1].front()));
    limit(postures.size(), "give poses by --animation");
    std::vector<Pose> result;
    for (const files::Posture& posture : postures) {
      Changes changes;
      changes.turns = posture.turns;
      result.push_back({unique(posture.name), points(changes)});
    }
    return result;
  }

private:
  const Gltf_scene& scene() const { return *m_mesh.scene; }
  const Json& node(std::size_t n) const { return member(scene().document, "nodes")[n]; }

  [[noreturn]] void fail(const std::string& message) const { throw Input_error(m_name + ": " + message); }

  // Counts of keyframes and of targets in a small file may be large.
  void limit(std::size_t poses, const char* mend) const
  {
    constexpr std::size_t most = std::size_t(1) << 28;
    if (poses > most / std::max<std::size_t>(m_mesh.points.size(), 1))
      fail("its poses have more than " + std::to_string(most) + " vertices in all; " + mend);
  }

  // A number in the document that refers to one of `size` things.
  std::size_t reference(const Json& object, const char* key, std::size_t size, const std::string& place) const
  {
    const Json* const number = object.is_object() && object.contains(key) ? &object[key] : nullptr;
    if (!number || !number->is_number_unsigned() || number->get<std::size_t>() >= size)
      fail(place + " names no " + key + ", or one that is not there; export the file again");
    return number->get<std::size_t>();
  }

  // A name as a part of that of a file.
  static std::string file_name(std::string name)
  {
    for (char& c : name)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '/' || c == '\\' || c == ':')
        c = '_';
    return name;
  }

  // Returns a name that was not returned before.
  std::string unique(const std::string& name)
  {
    std::string result = name;
    for (std::size_t number = 2; !m_taken.insert(result).second; ++number)
      result = name + "#" + std::to_string(number);
    return result;
  }

  const Json& mesh_of(const Gltf_scene::Instance& instance) const
  {
    return member(scene().document, "meshes")[reference(
        node(instance.node), "mesh", member(scene().document, "meshes").size(), "a node of the scene")];
  }

  std::vector<std::string> target_names(std::size_t number) const
  {
    const Gltf_scene::Instance& instance = scene().instances[number];
    const Json& extras = member(mesh_of(instance), "extras");
    const Json& given = extras.is_object() ? member(extras, "targetNames") : extras;
    std::vector<std::string> result;
    std::map<std::string, std::size_t> count;
    for (std::size_t target = 0; target < scene().blocks[instance.block].targets.size(); ++target) {
      std::string name = given.is_array() && target < given.size() && given[target].is_string()
                             ? given[target].get<std::string>()
                             : "";
      if (name.empty())
        name = "target_" + std::to_string(target);
      if (const std::size_t uses = ++count[name]; uses > 1)
        name += "#" + std::to_string(uses);
      result.push_back(std::move(name));
    }
    return result;
  }

  // Returns the rows of an accessor that the reader has left in the document; normalised integers are
  // fractions.
  Number_rows rows_of(std::size_t number, const std::string& place) const
  {
    const Json& document = scene().document;
    const Json& accessor = member(document, "accessors")[number];
    static const std::map<std::string, std::size_t> types = {
        {"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const auto type = types.find(accessor.value("type", ""));
    const std::size_t count = accessor.value("count", std::size_t(0));
    Gltf_scene::Column column;
    column.accessor = {{"normalized", accessor.value("normalized", false)}};
    column.component_type = accessor.value("componentType", 0);
    const std::size_t size = component_size(column.component_type);
    if (type == types.end() || count == 0 || size == 0 ||
        (column.component_type != type_float32 && (!column.is_normalized() || type->second == 16)))
      fail(place + " has an accessor of another type than glTF has for it; export the file again");
    column.components = type->second;
    column.row_size = column.components * size;
    const auto copied = [&](const Json& from, std::size_t rows, std::size_t row_size) {
      const std::size_t v = reference(from, "bufferView", scene().views.size(), place);
      const std::string& bytes = scene().views[v];
      const std::size_t offset = from.value("byteOffset", std::size_t(0)),
                        gap = member(document, "bufferViews")[v].value("byteStride", std::size_t(0)),
                        stride = gap == 0 ? row_size : gap;
      // No product overflows: the number of rows is at most that of bytes.
      if (rows > bytes.size() || offset > bytes.size() || row_size > bytes.size() - offset ||
          stride > bytes.size() || (rows - 1) * stride > bytes.size() - offset - row_size)
        fail(place + " reaches beyond buffer view " + std::to_string(v) + "; export the file again");
      std::string result;
      for (std::size_t i = 0; i < rows; ++i)
        result.append(bytes, offset + i * stride, row_size);
      return result;
    };
    if (!accessor.contains("bufferView") || accessor.contains("sparse"))
      fail(place + " has a sparse accessor, which is read for morph targets alone; export the file without");
    column.rows = copied(accessor, count, column.row_size);
    Number_rows result;
    result.components = column.components;
    result.numbers.reserve(count * column.components);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < column.components; ++k) {
        result.numbers.push_back(normalised(column, i, k));
        if (!std::isfinite(result.numbers.back()))
          fail(place + " has a number that is not finite; export the file again");
      }
    return result;
  }

  std::vector<Channel> channels_of(const Json& animation, const std::string& place)
  {
    static const std::map<std::string, Path> paths = {{"translation", Path::translation},
                                                      {"rotation", Path::rotation},
                                                      {"scale", Path::scale},
                                                      {"weights", Path::weights}};
    static const std::map<std::string, Interpolation> interpolations = {
        {"STEP", Interpolation::step},
        {"LINEAR", Interpolation::linear},
        {"CUBICSPLINE", Interpolation::cubic}};
    const Json &document = scene().document, &samplers = member(animation, "samplers");
    std::vector<Channel> result;
    for (const Json& json : member(animation, "channels")) {
      const Json& target = member(json, "target");
      const auto path = target.is_object() ? paths.find(target.value("path", "")) : paths.end();
      if (path == paths.end() || !target.contains("node"))
        continue; // of an extension
      Channel channel;
      channel.path = path->second;
      channel.node = Index(reference(target, "node", member(document, "nodes").size(), place));
      const Json& sampler = samplers[reference(json, "sampler", samplers.size(), place)];
      const auto kind = interpolations.find(sampler.value("interpolation", "LINEAR"));
      if (kind == interpolations.end())
        fail(place + " has an interpolation that glTF does not know; export the file again");
      channel.interpolation = kind->second;
      const std::size_t accessors = member(document, "accessors").size();
      const Number_rows times = rows_of(reference(sampler, "input", accessors, place), place),
                        values = rows_of(reference(sampler, "output", accessors, place), place);
      channel.times = times.numbers;
      channel.values = values.numbers;
      if (times.components != 1 || std::adjacent_find(channel.times.begin(), channel.times.end(),
                                                      std::greater_equal<>()) != channel.times.end())
        fail(place + " has keyframes whose times do not increase; export the file again");
      const std::size_t parts =
          channel.times.size() * (channel.interpolation == Interpolation::cubic ? 3 : 1);
      channel.size = channel.values.size() / parts;
      const bool is_of_weights = channel.path == Path::weights;
      const std::size_t wanted = is_of_weights                    ? targets_at(channel.node)
                                 : channel.path == Path::rotation ? 4
                                                                  : 3;
      if (channel.size * parts != channel.values.size() ||
          values.components != (is_of_weights ? 1 : wanted) || channel.size != wanted)
        fail(place + " has another number of values than its keyframes take; export the file again");
      if (!is_of_weights && node(channel.node).contains("matrix"))
        fail(place + " moves node " + std::to_string(channel.node) +
             ", which has a matrix; export it with translation, rotation and scale");
      result.push_back(std::move(channel));
    }
    return result;
  }

  // Returns how many targets the mesh at a node has.
  std::size_t targets_at(Index n) const
  {
    const Json& meshes = member(scene().document, "meshes");
    const Json& primitives =
        member(meshes[reference(node(n), "mesh", meshes.size(), "an animated node")], "primitives");
    return primitives.empty() ? 0 : member(primitives[0], "targets").size();
  }

  // Returns the transform of a node as the file has it.
  tinygltf::Node transform_of(std::size_t n) const
  {
    using Numbers = std::vector<double>;
    tinygltf::Node result;
    const Json& json = node(n);
    result.matrix = json.value("matrix", Numbers());
    result.translation = json.value("translation", Numbers());
    result.rotation = json.value("rotation", Numbers());
    result.scale = json.value("scale", Numbers());
    return result;
  }

  Changes changes_at(const std::vector<Channel>& channels, double time) const
  {
    Changes result;
    for (const Channel& channel : channels) {
      Channel::Value value = value_at(channel, time);
      if (channel.path == Path::weights) {
        result.weights[channel.node] = std::move(value);
        continue;
      }
      tinygltf::Node& moved = result.nodes.emplace(channel.node, transform_of(channel.node)).first->second;
      (channel.path == Path::translation ? moved.translation
       : channel.path == Path::rotation  ? moved.rotation
                                         : moved.scale) = std::move(value);
    }
    return result;
  }

  void read_skins()
  {
    const Json &document = scene().document, &skins = member(document, "skins");
    std::set<std::size_t> placed;
    for (const Gltf_scene::Placed_node& place : scene().placed_nodes)
      placed.insert(place.node);
    m_influences.resize(scene().instances.size());
    for (std::size_t i = 0; i < scene().instances.size(); ++i) {
      const Gltf_scene::Instance& instance = scene().instances[i];
      if (!node(instance.node).contains("skin"))
        continue;
      const std::size_t number = reference(node(instance.node), "skin", skins.size(), "a node of the scene");
      const std::string place = "skin " + std::to_string(number);
      Skin& skin = m_skins[number];
      if (skin.joints.empty()) {
        for (const Json& joint : member(skins[number], "joints")) {
          if (!joint.is_number_unsigned() || placed.count(joint.get<std::size_t>()) == 0)
            fail(place + " names a joint that is not in the scene; export the file again");
          skin.joints.push_back(joint.get<Index>());
        }
        skin.inverse_bind.assign(skin.joints.size(), identity_matrix);
        if (skins[number].contains("inverseBindMatrices")) {
          const Number_rows rows = rows_of(
              reference(skins[number], "inverseBindMatrices", member(document, "accessors").size(), place),
              place);
          if (rows.components != 16 || rows.size() < skin.joints.size())
            fail(place + " has fewer inverse bind matrices than joints; export the file again");
          for (std::size_t j = 0; j < skin.joints.size(); ++j)
            skin.inverse_bind[j] =
                files::matrix_of([&](std::size_t entry) { return rows.numbers[16 * j + entry]; });
        }
      }
      m_influences[i] = influences(scene().blocks[instance.block], skin, place);
    }
  }

  // Returns what moves each vertex of a block, in the order of the joints' nodes.
  std::vector<std::vector<Influence>> influences(const Gltf_scene::Block& block, const Skin& skin,
                                                 const std::string& place) const
  {
    std::vector<std::vector<Influence>> result(block.size);
    const auto find = [&](const std::string& name) {
      return std::find_if(block.attributes.begin(), block.attributes.end(),
                          [&](const Gltf_scene::Column& column) { return column.name == name; });
    };
    std::size_t sets = 0;
    for (auto joints = find("JOINTS_0"); joints != block.attributes.end();
         joints = find("JOINTS_" + std::to_string(++sets))) {
      const auto weights = find("WEIGHTS_" + std::to_string(sets));
      if (weights == block.attributes.end() || joints->components != 4 || weights->components != 4 ||
          joints->component_type == type_float32 ||
          (weights->component_type != type_float32 && !weights->is_normalized()))
        fail(place + ": the joints or weights of its mesh are of another type than glTF has for them; export "
                     "the file again");
      Cancellation_poll poll;
      for (Index v = 0; v < block.size; ++v) {
        poll();
        for (std::size_t k = 0; k < 4; ++k)
          if (const double weight = normalised(*weights, v, k); weight != 0) {
            const double joint = component(*joints, v, k);
            if (joint < 0 || joint >= double(skin.joints.size()))
              fail(place + ": vertex " + std::to_string(v) + " of its mesh names joint " +
                   std::to_string(std::int64_t(joint)) + ", which is not there; export the file again");
            result[v].push_back({std::size_t(joint), weight});
          }
      }
    }
    if (sets == 0)
      fail(place + ": its mesh has no joints and weights; export the file again");
    for (std::vector<Influence>& of_vertex : result)
      std::sort(of_vertex.begin(), of_vertex.end(), [&](const Influence& a, const Influence& b) {
        return std::make_pair(skin.joints[a.joint], a.weight) <
               std::make_pair(skin.joints[b.joint], b.weight);
      });
    return result;
  }

  std::vector<Matrix> to_world(const Changes& changes) const
  {
    std::vector<Matrix> result(member(scene().document, "nodes").size(), identity_matrix);
    for (const auto& [n, parent] : scene().placed_nodes) {
      const auto moved = changes.nodes.find(n);
      result[n] =
          files::product(parent ? result[*parent] : identity_matrix,
                         files::local_matrix(moved == changes.nodes.end() ? transform_of(n) : moved->second));
    }
    for (const files::Bone_turn& bone : changes.turns)
      if (!files::turn(bone, scene().placed_nodes, result))
        fail("node " + std::to_string(bone.node) + " is a bone without length; correct its skeleton");
    return result;
  }

  // Returns the weights of the targets of an instance.
  Channel::Value weights_of(std::size_t number, const Changes& changes) const
  {
    const Gltf_scene::Instance& instance = scene().instances[number];
    Channel::Value result(scene().blocks[instance.block].targets.size(), 0.0);
    if (changes.targets_at_one) {
      for (const std::size_t target : (*changes.targets_at_one)[number])
        result[target] = 1;
      return result;
    }
    Channel::Value given;
    const Json& json = node(instance.node);
    if (const auto found = changes.weights.find(instance.node); found != changes.weights.end())
      given = found->second;
    else
      given = (json.contains("weights") ? json : mesh_of(instance)).value("weights", Channel::Value());
    std::copy_n(given.begin(), std::min(given.size(), result.size()), result.begin());
    return result;
  }

  std::vector<Point_3> points(const Changes& changes) const
  {
    Cancellation_scope::check();
    const bool is_bind_pose = changes.targets_at_one.has_value();
    const std::vector<Matrix> world = is_bind_pose ? std::vector<Matrix>() : to_world(changes);
    std::vector<Point_3> of_scene;
    for (std::size_t i = 0; i < scene().instances.size(); ++i) {
      const Gltf_scene::Instance& instance = scene().instances[i];
      const std::vector<std::array<double, 3>> local = morphed(i, weights_of(i, changes));
      if (is_bind_pose || m_influences[i].empty()) {
        const Matrix matrix =
            is_bind_pose ? instance.to_world : files::product(world[instance.node], instance.in_node);
        for (const auto& point : local)
          of_scene.push_back(world_position(matrix, point));
        continue;
      }
      const Skin& skin = m_skins.at(node(instance.node)["skin"].get<std::size_t>());
      std::vector<Matrix> joints;
      for (std::size_t j = 0; j < skin.joints.size(); ++j)
        joints.push_back(files::product(world[skin.joints[j]], skin.inverse_bind[j]));
      for (std::size_t v = 0; v < local.size(); ++v) {
        Matrix matrix = {};
        for (const auto& [joint, weight] : m_influences[i][v])
          for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t column = 0; column < 4; ++column)
              matrix[row][column] += weight * joints[joint][row][column];
        of_scene.push_back(world_position(matrix, local[v]));
      }
    }
    std::vector<Point_3> result;
    result.reserve(m_mesh.points.size());
    for (const Index v : m_mesh.scene_vertices) {
      result.push_back(of_scene[v]);
      for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(of_scene[v][axis]))
          fail("a vertex has no finite position in one of its poses; correct the transforms");
    }
    return result;
  }

  // Returns the positions of the vertices of an instance, in their own space.
  std::vector<std::array<double, 3>> morphed(std::size_t number, const Channel::Value& weights) const
  {
    const Gltf_scene::Block& block = scene().blocks[scene().instances[number].block];
    std::vector<std::array<double, 3>> result(block.size);
    for (Index v = 0; v < block.size; ++v)
      for (std::size_t k = 0; k < 3; ++k)
        result[v][k] = component(block.attributes.front(), v, k);
    for (std::size_t target = 0; target < weights.size(); ++target)
      for (const Gltf_scene::Column& column : block.targets[target]) {
        if (column.name != "POSITION" || weights[target] == 0)
          continue;
        if (column.components != 3)
          fail("a morph target displaces by other than three numbers; export the file again");
        for (Index v = 0; v < block.size; ++v)
          for (std::size_t k = 0; k < 3; ++k)
            result[v][k] += weights[target] * normalised(column, v, k);
      }
    return result;
  }

  const Triangle_soup& m_mesh;
  const std::string& m_name;
  std::set<std::string> m_taken;
  std::map<std::size_t, Skin> m_skins;
  std::vector<std::vector<std::vector<Influence>>> m_influences; // of instances, empty where there is no skin
};

// What the JSON library finds wrong is the file's fault.
template <class Function>
std::vector<Pose> poses_of(const Triangle_soup& mesh, const std::string& name, const Function& function)
{
  try {
    Gltf_poser poser(mesh, name);
    return function(poser);
  } catch (const nlohmann::json::exception& error) {
    throw Input_error(name + ": not a valid glTF file (" + error.what() + "); export it again");
  }
}

} // namespace

bool has_morph_targets(const Triangle_soup& mesh)
{
  return mesh.scene && std::any_of(mesh.scene->blocks.begin(), mesh.scene->blocks.end(),
                                   [](const auto& block) { return !block.targets.empty(); });
}

std::vector<Pose> morph_poses(const Triangle_soup& mesh, const std::string& name)
{
  return poses_of(mesh, name, [](Gltf_poser& poser) { return poser.morphs(); });
}

bool has_humanoid(const Triangle_soup& mesh)
{
  try {
    return mesh.scene &&
           std::any_of(mesh.scene->instances.begin(), mesh.scene->instances.end(),
                       [&](const Gltf_scene::Instance& instance) {
                         return member(mesh.scene->document, "nodes")[instance.node].contains("skin");
                       }) &&
           files::find_humanoid(*mesh.scene).missing.empty();
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

std::vector<Pose> humanoid_poses(const Triangle_soup& mesh, const std::string& name)
{
  return poses_of(mesh, name, [](Gltf_poser& poser) { return poser.humanoids(); });
}

std::vector<Pose> animation_poses(const Triangle_soup& mesh, const std::string& animation, std::size_t every,
                                  const std::string& name)
{
  if (every == 0)
    throw Argument_error("every 0th keyframe is none; the number is at least 1");
  return poses_of(mesh, name, [&](Gltf_poser& poser) { return poser.animations(animation, every); });
}

} // namespace selvedge
