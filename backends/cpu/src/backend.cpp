#include "ao/cpu/backend.hpp"

#include "kernels.hpp"
#include "width.hpp"

#include "ao/kernel.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <new>
#include <string>
#include <utility>

namespace ao::cpu {

namespace detail {

void free_aligned::operator()(float* p) const
{
    ::operator delete[](p, std::align_val_t{ 64 });
}

struct machine {
    width lanes;
    const kernel_table& kernels;
    int tile_width;
    int tile_height;
    oneapi::tbb::task_arena arena;

    void run(kernel k, const pass_arguments& a)
    {
        const int columns = (a.width + tile_width - 1) / tile_width;
        const int rows = (a.height + tile_height - 1) / tile_height;
        const auto run_tiles = [&](const oneapi::tbb::blocked_range<int>& range) {
            for (int i = range.begin(); i < range.end(); ++i) {
                const int left = i % columns * tile_width;
                const int top = i / columns * tile_height;
                k(a, { left, top, std::min(left + tile_width, a.width), std::min(top + tile_height, a.height) });
            }
        };
        const oneapi::tbb::blocked_range<int> tiles(0, columns * rows);
        if (arena.max_concurrency() == 1) {
            run_tiles(tiles);
            return;
        }
        arena.execute([&] { oneapi::tbb::parallel_for(tiles, run_tiles); });
    }
};

namespace {

aligned_floats allocate(std::size_t count)
{
    return aligned_floats(static_cast<float*>(::operator new[](count * sizeof(float), std::align_val_t{ 64 }, std::nothrow)));
}

// Floats between rows: a multiple of a cache line, and no multiple of 1 KiB, at which a column's texels would share few sets
// of the first-level cache.
int padded_pitch(int pixels)
{
    const int lines = (pixels + 15) / 16;
    return 16 * (lines % 16 == 0 ? lines + 1 : lines);
}

plane plane_of(const image_view& v)
{
    return { static_cast<std::byte*>(v.data), v.row_bytes, bytes_per_pixel(v.format) / 4, v.format };
}

plane plane_of(const aligned_floats& floats, int pitch, std::size_t offset = 0)
{
    return { reinterpret_cast<std::byte*>(floats.get() + offset), static_cast<std::size_t>(pitch) * sizeof(float), 1,
             pixel_format::r32f };
}

std::optional<error> unfit(const image_view& v, const facts& f, pixel_format format, const char* name)
{
    const auto say = [&](errc code, const char* what) { return error(code, std::string(name) + ": " + what); };
    if (v.format != format) {
        return say(errc::unsupported_format, "format differs from the plan's");
    }
    if (v.data == nullptr) {
        return say(errc::invalid_size, "no data");
    }
    if (v.width != f.width || v.height != f.height) {
        return say(errc::invalid_size, "size differs from the plan's");
    }
    const auto pixel = static_cast<std::size_t>(bytes_per_pixel(format));
    if (v.row_bytes < static_cast<std::size_t>(v.width) * pixel || (format != pixel_format::r8 && v.row_bytes % 4 != 0)) {
        return say(errc::invalid_size, "row_bytes must hold a row and be a multiple of 4");
    }
    if (v.row_bytes / 4 > 0x7fffffffU / static_cast<std::size_t>(v.height)) {
        return say(errc::invalid_size, "more than 2^31 - 1 words");
    }
    return std::nullopt;
}

} // namespace

} // namespace detail

backend::backend(std::unique_ptr<detail::machine> m) : machine_(std::move(m)) {}
backend::backend(backend&&) noexcept = default;
backend& backend::operator=(backend&&) noexcept = default;
backend::~backend() = default;

width backend::lanes() const
{
    return machine_->lanes;
}

int backend::threads() const
{
    return machine_->arena.max_concurrency();
}

result<backend> backend::create(const options& o)
{
    if (o.threads < 0 || o.tile_width < 0 || o.tile_height < 0) {
        return error(errc::invalid_settings, "threads and tile size must not be negative");
    }
    const width lanes = o.lanes == width::automatic ? detail::widest() : o.lanes;
    if (!is_available(lanes)) {
        return error(errc::device, std::string("this machine or build does not have ") + std::string(name_of(lanes)));
    }
    try {
        // Asked for more than it allows, oneTBB would print a warning and start what it allows.
        using control = oneapi::tbb::global_control;
        const auto allowed = static_cast<int>(control::active_value(control::max_allowed_parallelism));
        const int threads = o.threads == 0 ? allowed : std::min(o.threads, allowed);
        std::unique_ptr<detail::machine> m(
            new detail::machine{ lanes, detail::kernels_of(lanes), o.tile_width > 0 ? o.tile_width : 64,
                                 o.tile_height > 0 ? o.tile_height : 64, oneapi::tbb::task_arena(threads) });
        m->arena.initialize();
        return backend(std::move(m));
    } catch (...) {
        return error(errc::out_of_memory, "oneTBB could not start its threads");
    }
}

result<program> backend::prepare(const plan& p)
{
    const int pitch = detail::padded_pitch(p.facts.width);
    const std::size_t pixels = static_cast<std::size_t>(pitch) * static_cast<std::size_t>(p.facts.height);
    if (pixels > 0x7fffffffU) {
        return error(errc::invalid_size, "more than 2^31 - 1 pixels");
    }
    program made;
    made.pitch_ = pitch;
    made.kernel_ = detail::allocate(4 * max_taps);
    constexpr std::size_t texels = tile_size * tile_size;
    made.rotation_ = detail::allocate(2 * texels);
    bool complete = made.kernel_ && made.rotation_;
    for (const transient_image& each : p.transients) {
        detail::aligned_floats& target = each.id == image_id::linear_depth     ? made.linear_depth_
                                         : each.id == image_id::raw_visibility ? made.raw_visibility_
                                                                               : made.row_sums_;
        target = detail::allocate(each.id == image_id::row_sums ? 2 * pixels : pixels);
        complete = complete && target;
    }
    if (!complete) {
        return error(errc::out_of_memory, "no memory for the pictures between the passes");
    }
    const auto kernel = make_kernel(p.settings.kernel, p.settings.taps, p.settings.seed);
    for (std::size_t i = 0; i < kernel.size(); ++i) {
        for (int j = 0; j < 4; ++j) {
            made.kernel_[4 * i + static_cast<std::size_t>(j)] = kernel[i][j];
        }
    }
    const auto rotation = make_rotation_tile(p.settings.seed);
    for (std::size_t i = 0; i < texels; ++i) {
        made.rotation_[i] = rotation[i].x;
        made.rotation_[texels + i] = rotation[i].y;
    }
    return made;
}

result<binding> backend::bind(program&, const plan& p, const host_images<image_view>& images)
{
    if (const auto wrong = detail::unfit(images.depth, p.facts, p.facts.depth_format, "depth")) {
        return *wrong;
    }
    if (p.facts.normals != normal_source::from_depth) {
        if (const auto wrong = detail::unfit(images.normal, p.facts, p.facts.normal_format, "normal")) {
            return *wrong;
        }
    }
    if (const auto wrong = detail::unfit(images.visibility, p.facts, p.facts.output_format, "visibility")) {
        return *wrong;
    }
    return binding(images);
}

void backend::record_pass(commands, program& prepared, binding& bound, const plan& p, std::size_t index)
{
    const pass& each = p.passes[index];
    const std::size_t pixels = static_cast<std::size_t>(prepared.pitch_) * static_cast<std::size_t>(p.facts.height);
    const auto find = [&](image_id id) -> detail::plane {
        switch (id) {
        case image_id::depth:
            return detail::plane_of(bound.images_.depth);
        case image_id::normal:
            return detail::plane_of(bound.images_.normal);
        case image_id::visibility:
            return detail::plane_of(bound.images_.visibility);
        case image_id::linear_depth:
            return detail::plane_of(prepared.linear_depth_, prepared.pitch_);
        case image_id::raw_visibility:
            return detail::plane_of(prepared.raw_visibility_, prepared.pitch_);
        case image_id::row_sums:
            return detail::plane_of(prepared.row_sums_, prepared.pitch_);
        default:
            return {};
        }
    };

    detail::pass_arguments a;
    a.options = each.options;
    std::memcpy(a.constants, each.constants.data(), each.constants_size);
    a.width = p.facts.width;
    a.height = p.facts.height;
    a.source = find(each.inputs[0]);
    a.normal = find(each.inputs[1]);
    a.target = find(each.output);
    a.counts = detail::plane_of(prepared.row_sums_, prepared.pitch_, prepared.row_sums_ ? pixels : 0);
    a.kernel = prepared.kernel_.get();
    a.rotation = prepared.rotation_.get();
    assert(a.source.data != nullptr && a.target.data != nullptr);

    const detail::kernel_table& kernels = machine_->kernels;
    switch (each.type) {
    case pass_type::linearize:
        return machine_->run(kernels.linearize, a);
    case pass_type::occlusion:
        return machine_->run(kernels.occlusion[each.options.parallel ? 1 : 0][each.options.limit_thickness ? 1 : 0], a);
    case pass_type::filter_rows:
        return machine_->run(kernels.filter_rows, a);
    case pass_type::filter_columns:
        return machine_->run(kernels.filter_columns, a);
    }
}

} // namespace ao::cpu
