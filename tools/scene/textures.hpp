#pragma once

#include "picture_files.hpp"
#include "scene.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <utility>

namespace ao::tools {

// What a texture is for: whether it is sRGB, and what stands in for it.
enum class texture_use { color, normals, mask };

// Of a height map, brighter is higher: x right, y up, z out of the picture, 0 ... 255 for -1 ... 1. The slope is `scale` for one
// full step from black to white between neighbours, which wrap around.
[[nodiscard]] picture normals_of_heights(const picture& heights, float scale);
[[nodiscard]] bool is_grey(const picture& p);

// Magenta and black squares for color, a flat normal, or white; 64 x 64.
[[nodiscard]] picture stand_in(texture_use use);

// Textures of one scene, each kept once per way of sampling it. What cannot be read becomes a stand-in and one warning per
// name, both in the scene.
class texture_shelf {
public:
    texture_shelf(scene& to, std::filesystem::path model_directory) : s(&to), directory(std::move(model_directory)) {}

    struct wrapping {
        ao::wrap_mode u = ao::wrap_mode::repeat;
        ao::wrap_mode v = ao::wrap_mode::repeat;

        bool operator==(const wrapping&) const = default;
    };

    // An embedded picture by that name, decoded already.
    void embed(const std::string& name, picture p);
    // An embedded picture that could not be decoded.
    void embed_broken(const std::string& name, const std::string& reason);

    // Index into scene::textures.
    [[nodiscard]] int add(const std::string& name, texture_use use, wrapping wrap);
    // Normals of the picture of that name: its own, or, where it is grey, those of the heights it holds.
    [[nodiscard]] int add_bumps(const std::string& name, float scale, wrapping wrap);
    // Whether the file has an alpha channel. False where it could not be read.
    [[nodiscard]] bool has_alpha(const std::string& name) { return find(name).p.has_alpha; }

private:
    struct source {
        picture p; // no texels where it could not be read
        std::string reason;
        bool warned = false;
    };
    source& find(const std::string& name);
    int put(const std::string& key, const std::string& name, const picture& p, texture_use use, wrapping wrap, bool missing);

    scene* s;
    std::filesystem::path directory;
    std::map<std::string, source> sources;
    std::map<std::string, int> indices;
};

} // namespace ao::tools
