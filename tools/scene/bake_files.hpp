#pragma once

#include "bake_model.hpp"

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace ao::tools {

// Values per vertex, as they are written. Spans are as long as there are positions, or empty where there is no such thing.
struct baked_values {
    std::span<const float> coefficients;
    std::span<const float> errors;
    std::span<const glm::vec3> bent;   // unit
    std::span<const glm::vec3> light;  // linear RGB
    std::span<const glm::vec3> colors; // what vertices are coloured with
};

enum class bake_format { ply, glb, obj, npy, csv };

// By the suffix, letter case ignored. Throws `error` for any other.
[[nodiscard]] bake_format bake_format_of(const std::string& path);

// The model, its polygons and normals, with vertex colours; whole files as bytes.
// PLY: binary, little-endian; colours in eight bits, the coefficient as `quality` in full.
[[nodiscard]] std::string ply_of(const bake_model& m, const baked_values& v);
// Binary glTF 2.0: COLOR_0 as floats. Polygons become triangles; those with a vertex that is not finite are left out. Positions
// that floats cannot tell apart where they are get a node's translation. Throws `error` beyond 4 GB.
[[nodiscard]] std::string glb_of(const bake_model& m, const baked_values& v);
// Colours behind the coordinates of each vertex, as MeshLab, Blender and others read them.
[[nodiscard]] std::string obj_of(const bake_model& m, const baked_values& v);
// An OBJ file as it is but for the colours: materials, texture coordinates, groups and all stay. Empty where the text has not as
// many vertices as the model, or goes on in the next line within one.
[[nodiscard]] std::string recolored_obj(std::string_view text, const baked_values& v);

// Values alone. npy (NumPy's format 1.0): float32 in C order, the coefficients, or with light an array of N x 3.
[[nodiscard]] std::string npy_of(const baked_values& v);
// "vertex,coefficient,error" with ",bent_x,bent_y,bent_z" and ",red,green,blue" where there are such; numbers that read back as
// the same float.
[[nodiscard]] std::string csv_of(const baked_values& v);

} // namespace ao::tools
