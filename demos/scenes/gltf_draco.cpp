// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_draco.hpp"

#include <map>
#include <memory>

#include "scenes/gltf_accessors.hpp"

#ifdef HALFSHADOW_HAS_DRACO
#include <draco/compression/decode.h>
#endif

namespace halfshadow::scenes {
#ifdef HALFSHADOW_HAS_DRACO
namespace {
constexpr const char* kExtension = "KHR_draco_mesh_compression";

int componentTypeOf(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return TINYGLTF_COMPONENT_TYPE_BYTE;
    case draco::DT_UINT8:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    case draco::DT_INT16:
      return TINYGLTF_COMPONENT_TYPE_SHORT;
    case draco::DT_UINT16:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    case draco::DT_UINT32:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    case draco::DT_FLOAT32:
      return TINYGLTF_COMPONENT_TYPE_FLOAT;
    default:
      return 0;
  }
}

class DracoDecoder {
 public:
  DracoDecoder(tinygltf::Model& model) : model_(model) {}

  Status decode(const Json& extension, tinygltf::Primitive& primitive, const std::string& what) {
    const auto view = countIn(extension, "bufferView");
    const auto mesh = meshOf(view ? static_cast<int>(*view) : -1);
    if (!mesh) {
      return malformed("the data of " + what + " under " + kExtension + " cannot be decoded (" +
                       mesh.error().message + "); export the file again, or uncompressed");
    }
    const Json* attributes = memberOf(extension, "attributes");
    for (const auto& [name, accessor] : primitive.attributes) {
      const auto id = attributes == nullptr ? std::nullopt : countIn(*attributes, name.c_str());
      if (!id) continue;
      const draco::PointAttribute* attribute =
          (*mesh)->GetAttributeByUniqueId(static_cast<std::uint32_t>(*id));
      if (attribute == nullptr || !fill(accessor, *attribute, **mesh)) {
        return malformed(name + " of " + what + " does not fit what its data under " + kExtension +
                         " holds; export the file again, or uncompressed");
      }
    }
    setTriangles(primitive, **mesh);
    return {};
  }

 private:
  using SharedMesh = std::shared_ptr<const draco::Mesh>;

  /// Primitives may share the data.
  Result<SharedMesh> meshOf(int view) {
    if (const auto found = meshes_.find(view); found != meshes_.end()) return found->second;
    const Result<ByteRange> range = bytesOfView(model_, view);
    if (!range) return range.error();
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(range->begin), range->size);
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) return malformed(decoded.status().error_msg_string());
    SharedMesh mesh = std::move(decoded).value();
    meshes_[view] = mesh;
    return mesh;
  }

  int addView(std::vector<unsigned char> bytes) {
    tinygltf::Buffer buffer;
    buffer.data = std::move(bytes);
    tinygltf::BufferView view;
    view.buffer = static_cast<int>(model_.buffers.size());
    view.byteLength = buffer.data.size();
    model_.buffers.push_back(std::move(buffer));
    model_.bufferViews.push_back(std::move(view));
    return static_cast<int>(model_.bufferViews.size()) - 1;
  }

  bool fill(int index, const draco::PointAttribute& attribute, const draco::Mesh& mesh) {
    const int componentType = componentTypeOf(attribute.data_type());
    if (index < 0 || static_cast<std::size_t>(index) >= model_.accessors.size() || componentType == 0)
      return false;
    tinygltf::Accessor& accessor = model_.accessors[index];
    if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) !=
        attribute.num_components()) {
      return false;
    }
    const auto stride = static_cast<std::size_t>(attribute.num_components()) *
                        static_cast<std::size_t>(draco::DataTypeLength(attribute.data_type()));
    std::vector<unsigned char> bytes(stride * mesh.num_points());
    for (std::uint32_t point = 0; point < mesh.num_points(); ++point)
      attribute.GetMappedValue(draco::PointIndex(point), bytes.data() + stride * point);
    accessor.bufferView = addView(std::move(bytes));
    accessor.byteOffset = 0;
    accessor.componentType = componentType;
    accessor.count = mesh.num_points();
    return true;
  }

  void setTriangles(tinygltf::Primitive& primitive, const draco::Mesh& mesh) {
    std::vector<unsigned char> bytes(mesh.num_faces() * std::size_t{12});
    for (std::uint32_t face = 0; face < mesh.num_faces(); ++face) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t corner = mesh.face(draco::FaceIndex(face))[k].value();
        std::memcpy(bytes.data() + std::size_t{12} * face + 4 * k, &corner, 4);
      }
    }
    tinygltf::Accessor accessor;
    accessor.bufferView = addView(std::move(bytes));
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    accessor.count = std::size_t{3} * mesh.num_faces();
    primitive.indices = static_cast<int>(model_.accessors.size());
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    model_.accessors.push_back(std::move(accessor));
  }

  tinygltf::Model& model_;
  std::map<int, SharedMesh> meshes_;
};
}  // namespace

Status decodeDraco(Json& json, tinygltf::Model& model) {
  DracoDecoder decoder(model);
  const std::vector<Json*> meshes = elementsOf(json, "meshes");
  for (std::size_t m = 0; m < meshes.size() && m < model.meshes.size(); ++m) {
    const std::vector<Json*> primitives = elementsOf(*meshes[m], "primitives");
    for (std::size_t p = 0; p < primitives.size() && p < model.meshes[m].primitives.size(); ++p) {
      const Json* extension = extensionOf(*primitives[p], kExtension);
      if (extension == nullptr) continue;
      const std::string what = "primitive " + std::to_string(p) + " of mesh " + std::to_string(m);
      if (Status status = decoder.decode(*extension, model.meshes[m].primitives[p], what); !status)
        return status;
    }
  }
  return {};
}
#else
Status decodeDraco(Json&, tinygltf::Model&) {
  return {};
}
#endif

}  // namespace halfshadow::scenes
