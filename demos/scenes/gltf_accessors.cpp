// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_accessors.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace halfshadow::scenes {
namespace {
constexpr std::size_t kMostElements = std::size_t{1} << 26;
/// An accessor without bytes of its own (all zeros, then sparse) could ask for any amount of memory: a few
/// hundred bytes of file for gigabytes. It stands beside others, which have bytes for as many.
constexpr std::size_t kMostZeros = std::size_t{1} << 18;

bool standsBesideAsMany(const tinygltf::Model& model, std::size_t count) {
  return std::ranges::any_of(model.accessors, [&](const tinygltf::Accessor& accessor) {
    const Result<ByteRange> range = bytesOfView(model, accessor.bufferView);
    return range.ok() && accessor.count >= count && accessor.count <= range->size;
  });
}

std::size_t componentsOfType(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    case TINYGLTF_TYPE_MAT4:
      return 16;
    default:
      return 0;
  }
}

std::size_t bytesOfComponent(int componentType) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

bool isUnsigned(int componentType) {
  return componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

template <typename T>
double numberAs(const unsigned char* bytes, bool normalized) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  const auto number = static_cast<double>(value);
  if (!normalized || std::is_floating_point_v<T>) return number;
  return std::max(number / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

double numberAt(const unsigned char* bytes, int componentType, bool normalized) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return numberAs<std::int8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return numberAs<std::uint8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return numberAs<std::int16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return numberAs<std::uint16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return numberAs<std::uint32_t>(bytes, normalized);
    default:
      return numberAs<float>(bytes, normalized);
  }
}

struct Layout {
  int componentType = 0;
  std::size_t components = 1, offset = 0, stride = 0, count = 0;
  bool normalized = false;
};

/// Writes layout.count elements to `numbers`, element i at place target(i).
template <typename Target>
Status copyNumbers(const tinygltf::Model& model, int view, const Layout& layout, const std::string& what,
                   std::vector<double>& numbers, Target target) {
  const Result<ByteRange> range = bytesOfView(model, view);
  if (!range) return Error{range.error().code, what + ": " + range.error().message};
  const std::size_t componentBytes = bytesOfComponent(layout.componentType);
  const std::size_t elementBytes = componentBytes * layout.components;
  const std::size_t stride = layout.stride != 0 ? layout.stride : elementBytes;
  if (stride < elementBytes) {
    return malformed(what + ": the byte stride " + std::to_string(stride) + " is less than one element's " +
                     std::to_string(elementBytes) + " bytes; export it again");
  }
  // Written without a product that could overflow: count - 1 strides and one element must fit.
  if (layout.count > 0 && (layout.offset > range->size || elementBytes > range->size - layout.offset ||
                           (layout.count - 1) > (range->size - layout.offset - elementBytes) / stride)) {
    return malformed(what + ": " + std::to_string(layout.count) + " elements overrun buffer view " +
                     std::to_string(view) + " of " + std::to_string(range->size) +
                     " bytes; the file is truncated or its counts are wrong");
  }
  for (std::size_t i = 0; i < layout.count; ++i) {
    const unsigned char* element = range->begin + layout.offset + i * stride;
    for (std::size_t c = 0; c < layout.components; ++c) {
      const double number = numberAt(element + c * componentBytes, layout.componentType, layout.normalized);
      if (!std::isfinite(number)) {
        return malformed(what + ": element " + std::to_string(i) + " is NaN or infinite; repair the mesh");
      }
      numbers[target(i) * layout.components + c] = number;
    }
  }
  return {};
}

Status applySparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor, const std::string& what,
                   AccessorValues& values) {
  const auto& sparse = accessor.sparse;
  if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0 ||
      static_cast<std::size_t>(sparse.count) > values.count) {
    return malformed(what + ": the sparse part has more elements than the accessor or negative offsets");
  }
  if (!isUnsigned(sparse.indices.componentType)) {
    return malformed(what + ": sparse indices must be unsigned bytes, shorts or ints");
  }
  const auto count = static_cast<std::size_t>(sparse.count);
  std::vector<double> places(count);
  Status status = copyNumbers(model, sparse.indices.bufferView,
                              {.componentType = sparse.indices.componentType,
                               .offset = static_cast<std::size_t>(sparse.indices.byteOffset),
                               .count = count},
                              what + ", sparse indices", places, [](std::size_t i) { return i; });
  if (!status) return status;
  for (const double place : places) {
    if (place >= static_cast<double>(values.count)) {
      return malformed(what + ": a sparse index points beyond the accessor's " +
                       std::to_string(values.count) + " elements");
    }
  }
  return copyNumbers(model, sparse.values.bufferView,
                     {.componentType = accessor.componentType,
                      .components = values.components,
                      .offset = static_cast<std::size_t>(sparse.values.byteOffset),
                      .count = count,
                      .normalized = accessor.normalized},
                     what + ", sparse values", values.numbers,
                     [&](std::size_t i) { return static_cast<std::size_t>(places[i]); });
}
}  // namespace

Result<ByteRange> bytesOfView(const tinygltf::Model& model, int viewIndex) {
  const std::string name = "buffer view " + std::to_string(viewIndex);
  if (viewIndex < 0 || static_cast<std::size_t>(viewIndex) >= model.bufferViews.size()) {
    return malformed(name + " does not exist; the file has " + std::to_string(model.bufferViews.size()));
  }
  const tinygltf::BufferView& view = model.bufferViews[viewIndex];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size()) {
    return malformed(name + " names buffer " + std::to_string(view.buffer) + ", which does not exist");
  }
  const std::vector<unsigned char>& bytes = model.buffers[view.buffer].data;
  if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset) {
    return malformed(name + " overruns buffer " + std::to_string(view.buffer) + " of " +
                     std::to_string(bytes.size()) + " bytes; the file is truncated or its lengths are wrong");
  }
  return ByteRange{bytes.data() + view.byteOffset, view.byteLength};
}

int indexIn(const tinygltf::Value& number) {
  if (!number.IsNumber()) return -1;
  const double value = number.GetNumberAsDouble();
  const bool fits = value >= 0.0 && value <= std::numeric_limits<int>::max() && value == std::floor(value);
  return fits ? static_cast<int>(value) : -1;
}

Result<AccessorValues> readAccessor(const tinygltf::Model& model, int index, const AccessorUse& use) {
  const std::string what = use.name + " (accessor " + std::to_string(index) + ")";
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size()) {
    return malformed(what + " does not exist; the file has " + std::to_string(model.accessors.size()) +
                     " accessors");
  }
  const tinygltf::Accessor& accessor = model.accessors[index];
  if (componentsOfType(accessor.type) != use.components) {
    return malformed(what + " has the wrong type: " + std::to_string(use.components) +
                     " numbers per element are needed");
  }
  if (bytesOfComponent(accessor.componentType) == 0) {
    return malformed(what + " has the unknown component type " + std::to_string(accessor.componentType));
  }
  if (use.integersOnly && (!isUnsigned(accessor.componentType) || accessor.normalized)) {
    return malformed(what + " must hold unsigned integers that are not normalised");
  }
  if (accessor.count > kMostElements) {
    return malformed(what + " has " + std::to_string(accessor.count) + " elements; at most " +
                     std::to_string(kMostElements) + " are supported: split the mesh");
  }
  AccessorValues values{.count = accessor.count, .components = use.components};
  if (accessor.bufferView >= 0) {
    const Result<ByteRange> range = bytesOfView(model, accessor.bufferView);
    if (!range) return malformed(what + ": " + range.error().message);
    if (accessor.count > range->size) {  // before memory is asked for
      return malformed(what + ": " + std::to_string(accessor.count) + " elements overrun buffer view " +
                       std::to_string(accessor.bufferView) +
                       "; the file is truncated or its counts are wrong");
    }
  } else if (accessor.count > kMostZeros && !standsBesideAsMany(model, accessor.count)) {
    return malformed(what + " has " + std::to_string(accessor.count) +
                     " elements but no buffer view; give it one, or make it as long as the mesh's others");
  }  // else all zeros, but for the sparse part
  values.numbers.assign(values.count * values.components, 0.0);
  if (accessor.bufferView >= 0) {
    const Status status = copyNumbers(model, accessor.bufferView,
                                      {.componentType = accessor.componentType,
                                       .components = use.components,
                                       .offset = accessor.byteOffset,
                                       .stride = model.bufferViews[accessor.bufferView].byteStride,
                                       .count = accessor.count,
                                       .normalized = accessor.normalized},
                                      what, values.numbers, [](std::size_t i) { return i; });
    if (!status) return status.error();
  }
  if (accessor.sparse.isSparse) {
    if (Status status = applySparse(model, accessor, what, values); !status) return status.error();
  }
  return values;
}

}  // namespace halfshadow::scenes
