#pragma once

#include "textures.hpp"

#include <assimp/material.h>
#include <assimp/texture.h>
#include <glm/mat2x2.hpp>

namespace ao::tools {

// A material of a model as the library knows it, and what its meshes have to do for it.
struct read_material {
    ao::standard_material material;
    unsigned uv_set = 0; // which of a mesh's texture coordinates its maps are read at
    // The place in the picture, v downward, is turn * uv + shift; `repeat` is not part of it.
    glm::mat2 turn{ 1.0f };
    glm::vec2 shift{ 0.0f };
};

// How the maps and numbers of models are taken:
// - Colors are linear numbers, those of MTL too (as Blender reads and writes them); pictures of colors are sRGB.
// - Ambient is diffuse: what exporters write into Ka means nothing. A black factor of a map counts as white.
// - Normal maps are green up. A grey bump map holds heights: normals are made, slope 2 times bump multiplier (MTL: -bm).
// - Alpha is a cut: glTF MASK by its cutoff, BLEND by 0.5, OPAQUE not at all; elsewhere an opacity map by 0.5, in its alpha
//   channel if it has one, else in red, or the diffuse map where the model says that its alpha counts. Opacity that is one
//   number is left out.
// - glTF's materials are two-sided where they say so, all others always.
// - Highlights: specular color and exponent; none for exponent 0 and MTL's illum 0 and 1. Phong where the model says Phong (illum
// 2),
//   else Blinn. Metal and roughness become a dielectric: 0.04 and exponent 2 / roughness^4 - 2, none where that is below 1.
// - Emission that comes from a picture is left out.
// `model`: path, for its extension. Warnings go to where those of the shelf go.
[[nodiscard]] read_material read_one(const aiMaterial& from, const std::string& model, texture_shelf& shelf, scene& warn);

// A picture inside a model: a file of its own, or raw texels. Throws `error` as decode_picture does.
[[nodiscard]] picture decode_embedded(const aiTexture& t);

// Whether drawing with it needs texture coordinates.
[[nodiscard]] bool has_maps(const ao::standard_material& m);
// The same without the maps that need texture coordinates.
[[nodiscard]] ao::standard_material without_maps(ao::standard_material m);

} // namespace ao::tools
