#include "ao/cpu/backend.hpp"

#include "machine.hpp"
#include "views.hpp"

#include "ao/kernel.hpp"

#include <cassert>
#include <cstring>
#include <utility>

namespace ao::cpu {

namespace detail {

void free_aligned::operator()(void* p) const
{
    ::operator delete[](p, std::align_val_t{ 64 });
}

void fill_rotation(float* to, std::span<const glm::vec2> rotation)
{
    for (std::size_t i = 0; i < rotation.size(); ++i) {
        to[i] = rotation[i].x;
        to[rotation.size() + i] = rotation[i].y;
    }
}

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
    return machine_->workers->count();
}

result<backend> backend::create(const options& o)
{
    auto made = detail::make_machine(o);
    if (!made) {
        return made.error();
    }
    return backend(std::move(*made));
}

result<program> backend::prepare(const plan& p)
{
    const int pitch = detail::padded_pitch(p.facts.width);
    const auto rows_of = [&](int height) { return static_cast<std::size_t>(pitch) * static_cast<std::size_t>(height); };
    if (rows_of(p.facts.height) > 0x7fffffffU) {
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
        target = detail::allocate((each.format == pixel_format::rg32f ? 2 : 1) * rows_of(each.height));
        complete = complete && target;
    }
    if (!complete) {
        return error(errc::out_of_memory, "no memory for the pictures between the passes");
    }
    const auto kernel = make_taps(p.settings);
    for (std::size_t i = 0; i < kernel.size(); ++i) {
        for (int j = 0; j < 4; ++j) {
            made.kernel_[4 * i + static_cast<std::size_t>(j)] = kernel[i][j];
        }
    }
    detail::fill_rotation(made.rotation_.get(), make_tile(p.settings));
    return made;
}

result<binding> backend::bind(program&, const plan& p, const host_images<image_view>& images)
{
    if (const auto wrong = detail::unfit(images.depth, p.facts.width, p.facts.height, p.facts.depth_format, "depth")) {
        return *wrong;
    }
    if (p.facts.normals != normal_source::from_depth) {
        if (const auto wrong = detail::unfit(images.normal, p.facts.width, p.facts.height, p.facts.normal_format, "normal")) {
            return *wrong;
        }
    }
    if (const auto wrong = detail::unfit(images.visibility, p.facts.width, p.facts.height, p.facts.output_format, "visibility")) {
        return *wrong;
    }
    return binding(images);
}

void backend::record_pass(commands, program& prepared, binding& bound, const plan& p, std::size_t index)
{
    const pass& each = p.passes[index];
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
    const extent size = extent_of(p, each.output);
    a.width = size.width;
    a.height = size.height;
    a.source = find(each.inputs[0]);
    a.normal = find(each.inputs[1]);
    a.depth = find(each.inputs[2]);
    a.target = find(each.output);
    // A picture of two components keeps the second one behind the first.
    const auto second = [&](image_id id) -> detail::plane {
        for (const transient_image& transient : p.transients) {
            if (transient.id == id && transient.format == pixel_format::rg32f) {
                const detail::aligned_floats& of = id == image_id::row_sums ? prepared.row_sums_ : prepared.raw_visibility_;
                const auto rows = static_cast<std::size_t>(transient.height);
                return detail::plane_of(of, prepared.pitch_, static_cast<std::size_t>(prepared.pitch_) * rows);
            }
        }
        return detail::plane{};
    };
    a.source_second = second(each.inputs[0]);
    a.target_second = second(each.output);
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
    case pass_type::bitmask:
        return machine_->run(kernels.bitmask[each.options.parallel ? 1 : 0], a);
    case pass_type::denoise_rows:
        return machine_->run(kernels.denoise_rows[each.options.coarse ? 1 : 0], a);
    case pass_type::denoise_columns:
        return machine_->run(kernels.denoise_columns[each.options.coarse ? 1 : 0], a);
    }
}

} // namespace ao::cpu
