#pragma once

#include "ao/scene.hpp"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace ao::tools {

// What a file of blends (docs/scenes.md) says about a model.
struct blend_file {
    std::vector<ao::blend_node> nodes;
    // As ao::object::material, one per name of the model: what its objects are drawn with. `as_is` where the file says nothing.
    // That of the object goes before that of its material.
    static constexpr int as_is = -2147483647 - 1;
    std::vector<int> of_object;
    std::vector<int> of_material;
};

struct model_names {
    std::span<const std::string> objects;
    std::span<const std::string> materials;
};

// Index of a texture for the picture at this path; throws `error`.
using mask_loader = std::function<int(const std::string& path)>;

// `name` is what errors begin with; masks are named relative to its directory, and each is loaded once. Throws `error` with line,
// column and path: what is no such file, a name that the model lacks, or of which there are two, and blends that contain
// themselves.
[[nodiscard]] blend_file parse_blends(const std::string& name, const std::string& text, const model_names& model,
                                      const mask_loader& load_mask);
[[nodiscard]] blend_file load_blends(const std::string& path, const model_names& model, const mask_loader& load_mask);

} // namespace ao::tools
