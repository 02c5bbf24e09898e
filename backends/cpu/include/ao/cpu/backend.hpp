// Executes plans on the CPU: the pass bodies over blocks of N pixels, tile by tile, on all cores.
//
// Inputs, as ao::facts describes them; rows in memory in the order of camera_projection::rows, pixel centres at + 0.5:
//   depth       linear: eye depth d = -z > 0 in scene units, r32f; 0, negative, NaN or infinite is background
//               hardware: d32f or r32f in [0, 1], or d24 in the low 24 bits of a 32-bit word (the upper 8 are ignored)
//               position: view space, right-handed, looking along -Z, scene units, rgba32f or rgba16f; only z is read
//   normal      view or world space; any length, zero and non-finite ones become +Z
//               rgba32f or rgba16f: xyz.  rgb10a2: xyz * 0.5 + 0.5, x in the low bits.
//               rg16: octahedral * 0.5 + 0.5, x in the low half.  Not looked at where it is rebuilt from depth.
// Output: visibility in [0, 1], 1 = open, r32f or r8 (to nearest); rgba16f with bent normals. It may not overlap inputs.
// Every view has exactly the plan's width and height, and at most 2^31 - 1 words of 4 bytes.
//
// Memory of a program: 4 bytes per pixel of eye depth unless the input is linear, 12 per pixel if there is a filter (of bitmask
// 16, at half resolution 6, twice that with bent normals), 16 KiB of kernel and 32 KiB of rotations. A binding is a few pointers.
// Nothing is allocated after prepare, other than tasks by oneTBB.
//
// record_pass runs the pass and returns when it is done: there is nothing to submit or to wait for. The calling thread works
// along. Calls may come from any thread; several at once are fine for different programs. A program belongs to one picture at a
// time. Assumes the default floating-point environment (round to nearest, denormals kept).
//
// Results are the same bits for every width, number of threads and tile size (exactness class Q of the shared functions).
#pragma once

#include "ao/backend.hpp"
#include "ao/cpu/image_view.hpp"

#include <cstddef>
#include <memory>
#include <string_view>

namespace ao::cpu {

// Pixels computed side by side.
enum class width {
    automatic, // the widest that this machine has
    scalar,    // math<float>, one pixel at a time: the reference
    lanes4,    // SSE2 or NEON; everywhere
    lanes8,    // AVX2
    lanes16,   // AVX-512 F, DQ, BW and VL
};

// "scalar", "4 lanes (SSE2)", ...
std::string_view name_of(width w);

// True where this build, processor and operating system have it.
bool is_available(width w);

struct options {
    width lanes = width::automatic;
    int threads = 0; // the calling one and oneTBB's together; 0, or more than oneTBB allows: all that it allows
    // Pixels of one task; 0: chosen. Any size gives the same bits; widths below 64 pixels cost time.
    int tile_width = 0;
    int tile_height = 0;
};

namespace detail {

struct free_aligned {
    void operator()(void* p) const;
};
using aligned_floats = std::unique_ptr<float[], free_aligned>;

struct machine; // the threads, and the kernels of a width

} // namespace detail

// Recording is execution.
struct commands {};

// Tables and pictures between the passes.
class program {
    friend class backend;
    int pitch_ = 0; // floats between rows of the pictures
    detail::aligned_floats kernel_;
    detail::aligned_floats rotation_;
    detail::aligned_floats linear_depth_;
    detail::aligned_floats raw_visibility_;
    detail::aligned_floats row_sums_; // all sums, then all counts
};

class binding {
    friend class backend;
    explicit binding(const host_images<image_view>& images) : images_(images) {}
    host_images<image_view> images_;
};

// Fulfils ao::backend. Must outlive its programs.
class backend {
public:
    using image = image_view;
    using commands = cpu::commands;
    using program = cpu::program;
    using binding = cpu::binding;

    // errc::device where the width is not available, errc::invalid_settings for negative numbers.
    static result<backend> create(const options& o = {});

    backend(backend&&) noexcept;
    backend& operator=(backend&&) noexcept;
    ~backend();

    // What was chosen.
    width lanes() const;
    int threads() const;

    result<program> prepare(const plan& p);
    // errc::unsupported_format, errc::invalid_size for views that do not fit the plan.
    result<binding> bind(program& prepared, const plan& p, const host_images<image_view>& images);
    // Precondition: `p` has the structure that the program was prepared for.
    void record_pass(commands, program& prepared, binding& bound, const plan& p, std::size_t index);

private:
    explicit backend(std::unique_ptr<detail::machine> m);
    std::unique_ptr<detail::machine> machine_;
};

static_assert(ao::backend<backend>);

} // namespace ao::cpu
