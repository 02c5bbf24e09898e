#pragma once

#include "scene.hpp"

#include "ao/texture.hpp"

#include <array>
#include <vector>

namespace ao::tools {

// Where alpha maps cut holes into triangles: as the geometry pass does, at the map's largest level.
class alpha_cut {
public:
    // Precondition: what s is drawn with passes ao::validate, or there are no materials. Throws `error` when the maps take more
    // memory than there may be.
    explicit alpha_cut(const scene& s);

    // Whether triangles of this object may have holes.
    [[nodiscard]] bool cuts(std::uint32_t object) const { return rules[object] != none; }

    // Makes a triangle of such an object known, numbered from 0 in the order of the calls.
    void add(const scene& s, std::uint32_t triangle);

    // At the point (1 - u - v) a + u b + v c of a triangle made known. From any number of threads.
    [[nodiscard]] bool hole(std::uint32_t number, float u, float v) const;

private:
    static constexpr std::uint32_t none = 0xffffffffu;

    struct map {
        int texture;
        glm::vec2 repeat;
        float cutoff;
        bool red;
    };
    struct cut_triangle {
        std::array<glm::vec2, 3> uvs;
        std::uint32_t rule;
    };

    std::vector<map> maps;
    std::vector<std::uint32_t> rules; // by object: index into maps
    std::vector<cut_triangle> triangles;
    ao::texel_heap heap;
};

} // namespace ao::tools
