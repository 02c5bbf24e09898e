#include "ao/view.hpp"

#include "ao/conformance/reference.hpp"
#include "scene/error.hpp"

#include <string>

namespace ao::tools {

using host::scene_picture;

view make_view(const render_options& o, const tools::camera& c, const tools::frustum& f)
{
    const auto wide = [](float x) { return static_cast<double>(x); };
    view v;
    v.effect.projection = make_projection({ wide(f.left), wide(f.right), wide(f.bottom), wide(f.top), wide(f.near), wide(f.far) },
                                          o.projection.options);
    v.drawing.projection = v.drawing.previous_projection = v.shading.projection = v.effect.projection;
    v.drawing.view = v.drawing.previous_view = v.shading.view = ao::matrix4(view_matrix(c));
    if (const auto planned = make_plan(o.settings, o.inputs, v.effect); !planned)
        throw error(std::string(planned.error().reason()));
    return v;
}

ao::shade_facts shade_facts_of(const render_options& o)
{
    ao::shade_facts f;
    f.width = o.size.width;
    f.height = o.size.height;
    f.stored_position = o.inputs.depth == depth_source::position;
    if (f.stored_position)
        f.position_format = o.inputs.depth_format;
    else if (o.inputs.depth == depth_source::hardware)
        f.depth_format = o.inputs.depth_format;
    f.normals = o.inputs.normals;
    f.normal_format = o.inputs.normal_format;
    f.parallel = o.inputs.parallel;
    f.bent_normal = o.settings.bent_normal;
    f.visibility_format = o.inputs.output_format;
    f.multi_bounce = o.multi_bounce;
    return f;
}

ao::gbuffer_facts targets_of(const render_options& o, const ao::scene& s, const ao::shade_plan* shaded)
{
    const ao::shade_facts known = shade_facts_of(o);
    ao::gbuffer_facts f;
    f.width = known.width;
    f.height = known.height;
    f.depth_format = known.depth_format;
    f.position = known.stored_position;
    f.position_format = known.position_format;
    f.normal = known.normals != normal_source::from_depth;
    f.normals = known.normals;
    f.normal_format = known.normal_format;
    f.ids = true;
    f.surface = shaded != nullptr && (shaded->options.maps || shaded->options.frames);
    f.frame = shaded != nullptr && shaded->options.frames && needs_frame(s);
    return f;
}

shown_surfaces show(const tools::gbuffer& g)
{
    return { g.hit, g.depth, g.normal };
}

shown_surfaces show(const picture_set& drawn, const ao::gbuffer_facts& f, const ao::camera_projection& projection)
{
    using real = ao::math<float>;
    const auto folded = fold_projection(projection, f.width, f.height);
    const ao::picture& ids = drawn[scene_picture::ids];
    const ao::picture& stored = drawn[f.position ? scene_picture::position : scene_picture::depth];
    const ao::picture& normals = drawn[scene_picture::normal];
    shown_surfaces s;
    s.hit.resize(ids.pixels());
    s.depth.resize(ids.pixels());
    s.normal.resize(normals.pixels());
    for (std::size_t i = 0; i < ids.pixels(); ++i) {
        s.hit[i] = ids.texel<glm::uvec2>(i).x != 0 ? 1 : 0;
        if (s.hit[i] == 0)
            continue;
        const glm::vec4 texel = conformance::decode_texel<float>(stored, i);
        const glm::vec2 centre(static_cast<float>(i % static_cast<std::size_t>(f.width)) + 0.5f,
                               static_cast<float>(i / static_cast<std::size_t>(f.width)) + 0.5f);
        s.depth[i] = f.position ? -texel.z : real::ao_eye_depth(folded->decode, centre, texel.x, folded->parallel);
        if (!s.normal.empty())
            s.normal[i] = glm::normalize(
                real::ao_decoded_normal(static_cast<int>(f.normals), conformance::decode_texel<float>(normals, i)));
    }
    return s;
}

} // namespace ao::tools
