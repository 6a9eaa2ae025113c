#include "io/tiles/mesh_bytes.h"

#include "io/tiles/byte_stream.h"

#include <stdexcept>

namespace oriel::detail {

std::string to_bytes(const FlatMesh& mesh) {
  ByteWriter writer;
  writer.put(mesh.features.size());
  for (const FlatFeature& feature : mesh.features) {
    for (const std::string* text :
         {&feature.building, &feature.id, &feature.label, &feature.surface, &feature.rule})
      writer.put(*text);
    writer.put(feature.score.has_value());
    writer.put(feature.score.value_or(0));
    writer.put(feature.height_m);
    writer.put(feature.colour.has_value());
    writer.put(feature.colour.value_or(FaceColour{}));
  }
  writer.put(mesh.points);
  writer.put(mesh.normals);
  writer.put(mesh.feature_of);
  writer.put(mesh.triangles);
  writer.put(mesh.edges);
  return writer.take();
}

FlatMesh flat_mesh_of(std::string_view bytes) {
  ByteReader reader(bytes);
  FlatMesh mesh;
  mesh.features.resize(reader.count(1));
  for (FlatFeature& feature : mesh.features) {
    for (std::string* text :
         {&feature.building, &feature.id, &feature.label, &feature.surface, &feature.rule})
      reader.get(*text);
    bool has_score = false, has_colour = false;
    double score = 0;
    FaceColour colour{};
    reader.get(has_score);
    reader.get(score);
    if (has_score) feature.score = score;
    reader.get(feature.height_m);
    reader.get(has_colour);
    reader.get(colour);
    if (has_colour) feature.colour = colour;
  }
  reader.get(mesh.points);
  reader.get(mesh.normals);
  reader.get(mesh.feature_of);
  reader.get(mesh.triangles);
  reader.get(mesh.edges);
  if (!reader.is_at_end()) throw std::runtime_error("bytes of a mesh go on behind its end");
  return mesh;
}

}  // namespace oriel::detail
