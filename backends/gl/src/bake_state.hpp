// What a baker keeps between bakes, and what it makes for one.
#pragma once

#include "ao/bake_gpu_driver.hpp"
#include "ao/gl/bake.hpp"
#include "object.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ao::gl {

// Texture units of shaders/bake.glsl.
enum bake_unit : std::uint32_t {
    vertices_unit,
    triangles_unit,
    points_unit,
    lines_unit,
    rotations_unit,
    seen_unit,
    nodes_unit = seen_unit, // of the hierarchy
    bake_unit_count
};

// Storage bindings.
enum bake_storage : std::uint32_t { sums_storage, words_storage, seen_storage, bake_storage_count };

struct bake_program {
    detail::bake_shader shader{};
    std::array<std::uint32_t, detail::bake_gpu_constants> constants{};
    object program;
};

struct bake_state {
    std::unique_ptr<functions> gl; // outlives the rest
    options chosen;
    bake_gpu_options cut;
    std::vector<bake_program> programs; // of the bakes so far
    std::uint32_t group = 0;
};

// The name of the program for these constants, linked where there is none yet.
result<GLuint> bake_program_of(bake_state& state, detail::bake_shader shader,
                               const std::array<std::uint32_t, detail::bake_gpu_constants>& constants);

struct bake_buffers {
    std::array<object, bake_unit_count> tables;
    std::array<object, bake_unit_count> textures; // of the tables; seen_unit's where the route has it
    object sums;
    object words;
    object launch;
};

// Makes the buffers of a part.
result<bake_buffers> make_bake_buffers(const functions& gl, const bake_job& job, const bake_request& part, bake_route route,
                                       const detail::bake_room& room);

// Returns when it is done.
std::optional<error> launch_bake(const bake_state& state, const bake_buffers& buffers, GLuint program,
                                 const detail::bake_launch& launch, std::uint32_t x, std::uint32_t y);

} // namespace ao::gl
