// What the program and the binding of a temporal plan hold.
#pragma once

#include "ao/gl/temporal.hpp"
#include "object.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace ao::gl {

// Texture units of shaders/temporal_accumulate.comp. linearize reads stored depth from unit 0, the filter the row values from 1.
inline constexpr GLsizei temporal_inputs = 6;
inline constexpr std::size_t row_unit = 1;
inline constexpr std::size_t history_unit = 4;
// Storage buffer binding: of the history that accumulate writes, and of the tiles.
inline constexpr GLuint written_index = 0;
// As constants_stride, for constants of up to 272 bytes.
inline constexpr GLintptr temporal_stride = 512;

struct temporal_program_state {
    temporal_plan plan;           // what it was prepared for
    std::vector<object> programs; // of its steps
    std::array<object, 2> histories;
    std::array<object, 2> history_textures;
    object linear; // eye depth, where the plan makes it
    object rows;   // where the plan filters
    object tiles;  // ao/shared/temporal_tiles.glsl
    object rotations;
    object taps;
    object tap_texture;
    object constants;
    object sampler;
};

struct temporal_binding_state {
    object depth_view; // unless the host's texture is mutable
    object normal_view;
    object motion_view;
    GLuint stored_depth = 0;
    GLuint depth = 0; // eye depth: the program's own, or the host's
    GLuint normal = 0;
    GLuint motion = 0;
    GLuint visibility = 0;
};

} // namespace ao::gl
