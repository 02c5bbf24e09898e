// What a compiled set of pass kernels offers: plain data and function pointers, so that code for an instruction set that the
// machine may lack stays behind them.
#pragma once

#include "ao/temporal.hpp"

#include <cstddef>
#include <cstdint>

namespace ao::cpu::detail {

// A picture as the kernels see it.
struct plane {
    std::byte* data = nullptr;
    std::size_t row_bytes = 0;
    int pixel_words = 1; // of 4 bytes; 0: r8
    pixel_format format = pixel_format::r32f;
};

struct pass_arguments {
    pass_options options;
    float constants[32] = {};
    int width = 0; // texels of the target
    int height = 0;
    plane source;        // depth, visibility or sums
    plane source_second; // component of a source of two
    plane target_second;
    plane normal;
    plane depth; // eye depth, beside packed visibility of half resolution
    plane target;
    const float* kernel = nullptr;   // x, y, z, 0 per tap
    const float* rotation = nullptr; // all x of the tile, then all y
};

// Pixels left ... right - 1 of rows top ... bottom - 1.
struct tile {
    int left = 0;
    int top = 0;
    int right = 0;
    int bottom = 0;
};

struct temporal_arguments {
    temporal_options options;
    float constants[sizeof(temporal_step::constants) / sizeof(float)] = {};
    int width = 0; // pixels of the picture
    int height = 0;
    plane depth; // eye depth
    plane normal;
    plane motion;
    plane rows; // of filter_rows, for filter_columns
    plane target;
    const std::uint32_t* read = nullptr; // histories (temporal_resources.hpp)
    std::uint32_t* write = nullptr;
    std::size_t history_plane = 0; // words between those of a pixel
    int history_words = 0;         // of a pixel
    const float* rotation = nullptr;
    const float* taps = nullptr; // all x, then all y, then all z
    std::size_t tap_plane = 0;   // floats of each
    // Of each row of each tile, row by row: whether a pixel in it is to be filtered. Written by resolve.
    std::uint8_t* filtered = nullptr;
    int tile_width = 1;
};

using kernel = void (*)(const pass_arguments&, const tile&);
using temporal_kernel = void (*)(const temporal_arguments&, const tile&);

struct accumulate_table {
    temporal_kernel of[3][2]; // [contribution_type][precise history]
};

struct temporal_kernel_table {
    accumulate_table accumulate[3]; // 0: still, 1: reproject, 2: reproject, cubic
    temporal_kernel filter_rows;
    temporal_kernel filter_columns;
    temporal_kernel resolve;
};

struct kernel_table {
    kernel linearize;
    kernel occlusion[2][2]; // [parallel][limit_thickness]
    kernel filter_rows;
    kernel filter_columns;
    kernel bitmask[2];      // [parallel]
    kernel denoise_rows[2]; // [coarse]
    kernel denoise_columns[2];
    const temporal_kernel_table& temporal;
};

const kernel_table& scalar_kernels();
const kernel_table& lanes4_kernels();
const kernel_table& lanes8_kernels();
const kernel_table& lanes16_kernels();

} // namespace ao::cpu::detail
