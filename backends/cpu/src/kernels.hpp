// What a compiled set of pass kernels offers: plain data and function pointers, so that code for an instruction set that the
// machine may lack stays behind them.
#pragma once

#include "ao/plan.hpp"

#include <cstddef>

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
    int width = 0; // pixels of the picture
    int height = 0;
    plane source; // depth, visibility or sums
    plane counts; // of the row sums, beside source or target
    plane normal;
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

using kernel = void (*)(const pass_arguments&, const tile&);

struct kernel_table {
    kernel linearize;
    kernel occlusion[2][2]; // [parallel][limit_thickness]
    kernel filter_rows;
    kernel filter_columns;
};

const kernel_table& scalar_kernels();
const kernel_table& lanes4_kernels();
const kernel_table& lanes8_kernels();
const kernel_table& lanes16_kernels();

} // namespace ao::cpu::detail
