#include "shader.hpp"

#include "ao_gl_shaders.hpp"
#include "compile.hpp"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace ao::gl {

namespace {

// constant_id of the shaders and their values; a boolean is 0 or 1.
constexpr std::size_t pass_constant_count = 9;
constexpr std::size_t group_constant_count = 2; // compute only, behind those of the passes
constexpr std::size_t slice_constant_count = 2;
using constant_values = std::array<GLuint, pass_constant_count + group_constant_count + slice_constant_count>;

constexpr std::array<GLuint, 4> linearize_ids{ 0, 8, 9, 10 };
constexpr std::array<GLuint, 8> occlusion_ids{ 1, 2, 3, 4, 5, 6, 9, 10 };
constexpr std::array<GLuint, 3> filter_ids{ 7, 9, 10 };
constexpr std::array<GLuint, 9> bitmask_ids{ 1, 2, 3, 4, 6, 11, 12, 9, 10 };
constexpr std::array<GLuint, 7> denoise_ids{ 2, 3, 4, 7, 12, 9, 10 };

source source_of(pass_type type, route by)
{
    using namespace shaders;
    const bool compute = by == route::compute;
    const auto pick = [&](source s) {
        if (!compute) {
            s.constant_ids = s.constant_ids.first(s.constant_ids.size() - group_constant_count);
        }
        return s;
    };
    switch (type) {
    case pass_type::linearize:
        return pick({ compute ? linearize_comp : linearize_frag, compute ? linearize_comp_text : linearize_frag_text,
                      linearize_ids, "linearize" });
    case pass_type::occlusion:
        return pick({ compute ? occlusion_comp : occlusion_frag, compute ? occlusion_comp_text : occlusion_frag_text,
                      occlusion_ids, "occlusion" });
    case pass_type::filter_rows:
        return pick({ compute ? filter_rows_comp : filter_rows_frag, compute ? filter_rows_comp_text : filter_rows_frag_text,
                      filter_ids, "filter rows" });
    case pass_type::bitmask:
        return pick(
            { compute ? bitmask_comp : bitmask_frag, compute ? bitmask_comp_text : bitmask_frag_text, bitmask_ids, "bitmask" });
    case pass_type::denoise_rows:
        return pick({ compute ? denoise_rows_comp : denoise_rows_frag, compute ? denoise_rows_comp_text : denoise_rows_frag_text,
                      denoise_ids, "denoise rows" });
    case pass_type::denoise_columns:
        return pick({ compute ? denoise_columns_comp : denoise_columns_frag,
                      compute ? denoise_columns_comp_text : denoise_columns_frag_text, denoise_ids, "denoise columns" });
    case pass_type::filter_columns:
        break;
    }
    return pick({ compute ? filter_columns_comp : filter_columns_frag,
                  compute ? filter_columns_comp_text : filter_columns_frag_text, filter_ids, "filter columns" });
}

} // namespace

result<object> link_pass(const functions& gl, const options& chosen, const pass& p, bool from_position)
{
    const pass_options& o = p.options;
    const constant_values values{ o.affine,
                                  static_cast<GLuint>(o.tap_count),
                                  static_cast<GLuint>(o.normal_source),
                                  o.rotate_normals,
                                  o.parallel,
                                  o.limit_thickness,
                                  o.mark_background,
                                  static_cast<GLuint>(o.filter_radius),
                                  from_position,
                                  chosen.group_width,
                                  chosen.group_height,
                                  static_cast<GLuint>(o.slice_count),
                                  o.coarse };
    const bool compute = chosen.route == route::compute;
    const source from = source_of(p.type, chosen.route);

    std::vector<object> stages;
    result<object> main = compile(gl, chosen.source, compute ? GL_COMPUTE_SHADER : GL_FRAGMENT_SHADER, from, values);
    if (!main) {
        return main.error();
    }
    stages.push_back(std::move(*main));
    if (!compute) {
        const source triangle{ shaders::full_screen_vert, shaders::full_screen_vert_text, {}, "full-screen triangle" };
        result<object> vertex = compile(gl, chosen.source, GL_VERTEX_SHADER, triangle, values);
        if (!vertex) {
            return vertex.error();
        }
        stages.push_back(std::move(*vertex));
    }
    return link(gl, from.name, stages);
}

} // namespace ao::gl
