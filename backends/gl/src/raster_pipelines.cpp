#include "ao_gl_shaders.hpp"
#include "compile.hpp"
#include "raster_state.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace ao::gl {

namespace {

constexpr geometry_options constant_ids{ 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 };

result<object> link_geometry(const functions& gl, shader_source chosen, const geometry_options& values)
{
    const source vertex{ shaders::geometry_vert, shaders::geometry_vert_text, constant_ids, "geometry, vertices" };
    const source fragment{ shaders::geometry_frag, shaders::geometry_frag_text, constant_ids, "geometry, fragments" };
    std::array<object, 2> stages;
    result<object> first = compile(gl, chosen, GL_VERTEX_SHADER, vertex, values);
    if (!first) {
        return first.error();
    }
    stages[0] = std::move(*first);
    result<object> second = compile(gl, chosen, GL_FRAGMENT_SHADER, fragment, values);
    if (!second) {
        return second.error();
    }
    stages[1] = std::move(*second);
    return link(gl, "geometry", stages);
}

object make_vertex_array(const functions& gl, const draw_variant& v, const gbuffer_facts& f)
{
    object made = make_object(gl, object_type::vertex_array, gl.CreateVertexArrays);
    const auto add = [&](GLuint which, bool wanted) {
        if (wanted) {
            gl.EnableVertexArrayAttrib(made.name(), which);
            gl.VertexArrayAttribFormat(made.name(), which, vertex_attribute_floats[which], GL_FLOAT, GL_FALSE, 0);
            gl.VertexArrayAttribBinding(made.name(), which, which);
        }
    };
    add(position_attribute, true);
    add(normal_attribute, reads_normals(v, f));
    add(tangent_attribute, reads_tangents(v));
    add(uv_attribute, v.uvs);
    add(previous_attribute, v.deforming);
    gl.EnableVertexArrayAttrib(made.name(), slot_attribute);
    gl.VertexArrayAttribIFormat(made.name(), slot_attribute, 1, GL_UNSIGNED_INT, 0);
    gl.VertexArrayAttribBinding(made.name(), slot_attribute, slot_attribute);
    gl.VertexArrayBindingDivisor(made.name(), slot_attribute, 1);
    return made;
}

} // namespace

std::optional<error> make_pipelines(const functions& gl, const raster_options& chosen, const draw_plan& p,
                                    raster_model_state& into)
{
    std::vector<geometry_options> made;
    for (const draw_variant& v : p.variants) {
        const geometry_options values = make_geometry_options(v, p.facts, chosen.sampling == sampling::hardware);
        const auto same = std::find(made.begin(), made.end(), values);
        raster_pipeline pipeline;
        pipeline.variant = v;
        pipeline.program = static_cast<std::size_t>(same - made.begin());
        pipeline.vertex_array = make_vertex_array(gl, v, p.facts);
        if (same == made.end()) {
            result<object> linked = link_geometry(gl, chosen.source, values);
            if (!linked) {
                return linked.error();
            }
            into.programs.push_back(std::move(*linked));
            made.push_back(values);
        }
        into.pipelines.push_back(std::move(pipeline));
    }
    return std::nullopt;
}

} // namespace ao::gl
