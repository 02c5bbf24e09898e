#include "micro/courtyard_input.hpp"

#include "scene/camera.hpp"
#include "scene/courtyard.hpp"
#include "scene/gbuffer.hpp"
#include "scene/ray_tree.hpp"

namespace ao::bench {

input courtyard_input(int width, int height)
{
    static const tools::scene scene = tools::courtyard();
    static const tools::ray_tree tree(scene);
    const tools::camera view = tools::courtyard_camera();
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    const tools::frustum f = tools::perspective(view, aspect, tools::clip_range(tools::bounds_of(scene), view));
    const tools::gbuffer g = tools::trace_gbuffer(scene, tree, view, f, width, height);

    input in;
    in.facts.width = width;
    in.facts.height = height;
    in.facts.normal_format = pixel_format::rgba16f;
    const auto wide = [](float x) { return static_cast<double>(x); };
    projection_options options;
    options.rows = first_row::at_ndc_plus_one;
    in.camera.projection =
        make_projection({ wide(f.left), wide(f.right), wide(f.bottom), wide(f.top), wide(f.near), wide(f.far) }, options);
    in.depth = pack_depth(g.depth, width, height, in.facts.depth, in.facts.depth_format, in.camera.projection);
    in.normal = pack_normals(g.normal, width, height, in.facts.normals, in.facts.normal_format);
    return in;
}

} // namespace ao::bench
