#pragma once

namespace ao::gl {

enum class route {
    compute,  // a dispatch per pass
    fragment, // a full-screen triangle per pass
};

enum class shader_source {
    automatic, // spirv where the driver offers it, else text
    spirv,     // OpenGL 4.6 or ARB_gl_spirv
    text,      // GLSL 4.50; for drivers whose SPIR-V is missing or broken
};

// The picture is the same in every bit for any choice here.
struct options {
    gl::route route = gl::route::compute;
    gl::shader_source source = gl::shader_source::automatic;
    // Compute only: pixels per work group. Times of the 32-tap pass on llvmpipe relative to 16x16: 8x8 1.2, 16x8 1.1, 32x4 1.25,
    // 64x1 1.4; 32x32 is 5 % faster there but slower in the filter. Not measured on a GPU.
    unsigned group_width = 16;
    unsigned group_height = 16;
    // Whether each recorded pass puts back the state it changed. Costs about fifty glGet calls a pass, which on drivers with
    // a thread of their own wait for it; a host that resets its state anyway turns it off (list in backend.hpp).
    bool restore_state = true;
};

enum class sampling {
    shared,   // trilinear by ao/shared/texture.h: the same texels and weights on every backend
    hardware, // trilinear by the driver's sampler: faster on GPUs, weights in steps of 1/256 or so
};

// Of the rasterizer.
struct raster_options {
    shader_source source = shader_source::automatic;
    gl::sampling sampling = gl::sampling::shared; // of alpha and normal maps
    bool restore_state = true;                    // as options::restore_state, once a geometry pass
};

} // namespace ao::gl
