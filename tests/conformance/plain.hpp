// A fourth backend, written as a stranger would from ao/backend.hpp and the pass headers alone: a double loop over
// math<float>, pictures of its own. It may carry a planted fault, which the suite must find.
#pragma once

#include "ao/backend.hpp"
#include "ao/kernel.hpp"
#include "ao/passes.hpp"
#include "ao/plan.hpp"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace plain {

enum class fault {
    none,
    bias_ignored,
    texel_beside,
    border_short,
    tile_transposed,
    thickness_ignored,
    last_tap_lost,
    whole_lost
};

// Texels of four floats, as a texture unit would deliver them.
struct image {
    int width = 0;
    int height = 0;
    std::vector<glm::vec4> texels;

    glm::vec4& at(int x, int y)
    {
        return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

struct commands {};

struct program {
    std::array<glm::vec4, ao::max_taps> kernel;
    std::array<image, static_cast<std::size_t>(ao::image_id::none) + 1> pictures;
};

struct binding {
    ao::host_images<image*> images;
};

// The callbacks of every pass.
struct resources {
    std::array<image*, 3> inputs;
    const program* tables;
    bool position;
    fault planted;
    bool denoises = false; // the first input is packed visibility and eye depth
    bool coarse = false;   // the third input is eye depth

    glm::vec4 fetch(std::size_t input, glm::ivec2 p) const { return inputs[input]->at(p.x, p.y); }
    float stored_depth(glm::ivec2 p) const { return position ? fetch(0, p).z : fetch(0, p).x; }
    float depth(glm::ivec2 p) const
    {
        const std::size_t input = denoises && coarse ? 2 : 0;
        const int beside = planted == fault::texel_beside ? std::min(p.x + 1, inputs[input]->width - 1) : p.x;
        const glm::vec4 texel = fetch(input, { beside, p.y });
        return denoises && !coarse ? texel.y : texel.x;
    }
    glm::vec4 normal(glm::ivec2 p) const { return fetch(1, p); }
    glm::vec2 rotation(glm::ivec2 p) const
    {
        return glm::vec2(fetch(2, planted == fault::tile_transposed ? glm::ivec2(p.y, p.x) : p));
    }
    glm::vec4 tap(int i) const { return tables->kernel[static_cast<std::size_t>(i)]; }
    float visibility(glm::ivec2 p) const { return fetch(0, p).x; }
    glm::vec2 row_sum(glm::ivec2 p) const { return glm::vec2(fetch(0, p)); }
    glm::vec2 packed(glm::ivec2 p) const { return glm::vec2(fetch(0, p)); }
    glm::vec2 directions(glm::ivec2 p) const
    {
        const glm::vec4 texel = fetch(0, p);
        return planted == fault::whole_lost ? glm::vec2(texel.z, texel.z) : glm::vec2(texel.z, texel.w);
    }
};

class backend {
public:
    using image = plain::image*;
    using commands = plain::commands;
    using program = plain::program;
    using binding = plain::binding;
    fault planted = fault::none;

    ao::result<program> prepare(const ao::plan& p)
    {
        program made{ ao::make_taps(p.settings), {} };
        plain::image& tile = made.pictures[static_cast<std::size_t>(ao::image_id::rotation)];
        tile = { ao::tile_size, ao::tile_size, {} };
        for (const glm::vec2 helper : ao::make_tile(p.settings)) {
            tile.texels.emplace_back(helper, 0.0F, 0.0F);
        }
        for (const ao::transient_image& each : p.transients) {
            plain::image& picture = made.pictures[static_cast<std::size_t>(each.id)];
            picture = { each.width, each.height, {} };
            picture.texels.resize(static_cast<std::size_t>(each.width) * static_cast<std::size_t>(each.height));
        }
        return made;
    }

    ao::result<binding> bind(program&, const ao::plan&, const ao::host_images<image>& images) { return binding{ images }; }

    void record_pass(commands, program& prepared, binding& bound, const ao::plan& p, std::size_t index)
    {
        const ao::pass& each = p.passes[index];
        const ao::pass_options& o = each.options;
        const resources read{ { find(prepared, bound, each.inputs[0]), find(prepared, bound, each.inputs[1]),
                                find(prepared, bound, each.inputs[2]) },
                              &prepared,
                              p.facts.depth == ao::depth_source::position,
                              planted,
                              each.type == ao::pass_type::denoise_rows || each.type == ao::pass_type::denoise_columns,
                              o.coarse };
        plain::image& out = *find(prepared, bound, each.output);
        for (int y = 0; y < out.height; ++y) {
            for (int x = 0; x < out.width; ++x) {
                out.at(x, y) = run(each, o, read, { x, y });
            }
        }
    }

private:
    static image find(program& prepared, binding& bound, ao::image_id id)
    {
        switch (id) {
        case ao::image_id::depth:
            return bound.images.depth;
        case ao::image_id::normal:
            return bound.images.normal;
        case ao::image_id::visibility:
            return bound.images.visibility;
        default:
            return &prepared.pictures[static_cast<std::size_t>(id)];
        }
    }

    glm::vec4 run(const ao::pass& each, const ao::pass_options& o, const resources& read, glm::ivec2 pixel) const
    {
        if (each.type == ao::pass_type::linearize) {
            ao::linearize_pass<float, resources> body{ read, o.affine };
            const auto c = ao::constants_of<ao::linearize_constants>(each);
            return { body.ao_linearize_pass(std::bit_cast<decltype(body)::ao_depth_decode>(c), pixel), 0, 0, 0 };
        }
        if (each.type == ao::pass_type::occlusion) {
            const int taps = planted == fault::last_tap_lost ? o.tap_count - 1 : o.tap_count;
            const bool limited = o.limit_thickness && planted != fault::thickness_ignored;
            ao::occlusion_pass<float, resources> body{ read,       taps,    o.normal_source,  o.rotate_normals,
                                                       o.parallel, limited, o.mark_background };
            auto c = ao::constants_of<ao::occlusion_constants>(each);
            c.bias = planted == fault::bias_ignored ? 0.0F : c.bias;
            return { body.ao_occlusion_pass(std::bit_cast<decltype(body)::ao_occlusion_constants>(c), pixel), 0, 0, 0 };
        }
        if (each.type == ao::pass_type::bitmask) {
            const int taps = planted == fault::last_tap_lost ? o.tap_count - 2 : o.tap_count;
            ao::bitmask_pass<float, resources> body{
                read,     taps,         o.slice_count, o.normal_source, o.rotate_normals, o.parallel, o.mark_background,
                o.coarse, o.bent_normal
            };
            auto c = ao::constants_of<ao::occlusion_constants>(each);
            c.bias = planted == fault::bias_ignored ? 0.0F : c.bias;
            c.thickness = planted == fault::thickness_ignored ? 1e30F : c.thickness;
            const auto constants = std::bit_cast<decltype(body)::ao_occlusion_constants>(c);
            if (o.bent_normal) {
                return o.mark_background ? body.ao_bitmask_bent_packed_pass(constants, pixel)
                                         : body.ao_bitmask_bent_pass(constants, pixel);
            }
            if (o.mark_background) {
                return { body.ao_bitmask_packed_pass(constants, pixel), 0, 0 };
            }
            return { body.ao_bitmask_pass(constants, pixel).visibility, 0, 0, 0 };
        }
        if (each.type == ao::pass_type::denoise_rows || each.type == ao::pass_type::denoise_columns) {
            ao::denoise_pass<float, resources> body{ read,       o.filter_radius, o.normal_source, o.rotate_normals,
                                                     o.parallel, o.coarse,        o.bent_normal };
            auto c = ao::constants_of<ao::denoise_constants>(each);
            c.width -= planted == fault::border_short ? 1.0F : 0.0F;
            const auto constants = std::bit_cast<decltype(body)::ao_denoise_constants>(c);
            if (o.bent_normal) {
                return each.type == ao::pass_type::denoise_rows ? body.ao_denoise_rows_bent_pass(constants, pixel)
                                                                : body.ao_denoise_columns_bent_pass(constants, pixel);
            }
            if (each.type == ao::pass_type::denoise_rows) {
                return { body.ao_denoise_rows_pass(constants, pixel), 0, 0 };
            }
            return { body.ao_denoise_columns_pass(constants, pixel), 0, 0, 0 };
        }
        ao::filter_pass<float, resources> body{ read, o.filter_radius };
        auto c = ao::constants_of<ao::filter_constants>(each);
        c.width -= planted == fault::border_short ? 1.0F : 0.0F;
        const auto constants = std::bit_cast<decltype(body)::ao_filter_constants>(c);
        if (each.type == ao::pass_type::filter_rows) {
            return { body.ao_filter_rows_pass(constants, pixel), 0, 0 };
        }
        return { body.ao_filter_columns_pass(constants, pixel), 0, 0, 0 };
    }
};

static_assert(ao::backend<backend>);

} // namespace plain
