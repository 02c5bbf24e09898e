#include "ao/temporal_frames.hpp"

#include "ao/look.hpp"
#include "ao/outcome.hpp"
#include "ao/ray_pictures.hpp"

#include <glm/vec4.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ao::tools {
namespace {

motion choose(const render_options& o, const tools::scene& rest)
{
    const motion_stage stage{ rest, choose_camera(o, bounds_of(rest)), bundled(o.scene) && moves_courtyard(o.temporal->motion),
                              o.frames, o.size.height };
    return choose_motion(o.temporal->motion, stage);
}

bool same(const tools::camera& a, const tools::camera& b)
{
    return a.eye == b.eye && a.yaw == b.yaw && a.pitch == b.pitch && a.fov == b.fov;
}

// Of each object's vertices; those of objects without triangles are not to be looked at.
std::vector<bounds> boxes_of(const tools::scene& s, std::vector<std::uint8_t>& used)
{
    std::vector<bounds> boxes(s.object_names.size());
    used.assign(boxes.size(), 0);
    for (std::size_t t = 0; t < s.triangles.size(); ++t)
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec3 p = s.positions[s.triangles[t][corner]];
            bounds& b = boxes[s.object[t]];
            if (used[s.object[t]] == 0)
                b = { p, p };
            used[s.object[t]] = 1;
            b = { glm::min(b.low, p), glm::max(b.high, p) };
        }
    return boxes;
}

// What encloses the scene in every frame.
bounds bounds_of_all(const tools::scene& rest, const motion& moves, int frames)
{
    bounds all = bounds_of(rest);
    if (!moves.moves_objects())
        return all;
    std::vector<std::uint8_t> used;
    const std::vector<bounds> boxes = boxes_of(rest, used);
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (int f = 0; f < frames && used[i] != 0; ++f) {
            const glm::dmat4 to = moves.transform(i, f);
            if (to == glm::dmat4(1.0))
                continue;
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec4 p((corner & 1) != 0 ? boxes[i].high.x : boxes[i].low.x,
                                   (corner & 2) != 0 ? boxes[i].high.y : boxes[i].low.y,
                                   (corner & 4) != 0 ? boxes[i].high.z : boxes[i].low.z, 1.0);
                const glm::vec3 moved(to * p);
                all = { glm::min(all.low, moved), glm::max(all.high, moved) };
            }
        }
    return all;
}

// Near stays within what clip_range promises.
depth_range range_of_all(const bounds& b, const motion& moves, int frames)
{
    depth_range all = clip_range(b, moves.camera_at(0));
    for (int f = 1; f < frames && moves.moves_camera(); ++f) {
        const depth_range each = clip_range(b, moves.camera_at(f));
        all = { std::min(all.near, each.near), std::max(all.far, each.far) };
    }
    all.near = std::max(all.near, all.far / 1000.0f);
    return all;
}

} // namespace

temporal_frames::temporal_frames(const render_options& o, scene_input& input)
    : options_(o),
      input_(input),
      moves_(choose(o, input.model)),
      camera_(moves_.camera_at(0)),
      before_(camera_)
{
    const bounds b = bounds_of_all(input.model, moves_, o.frames);
    range_ = range_of_all(b, moves_, o.frames);
    distance_ = distance_to_middle(camera_, b);
    facts_.frame = o.inputs;
    facts_.motion = moves_.moves_objects();
    facts_.motion_format = pixel_format::rgba32f;
    targets_ = targets_of(o, input.drawn.get(), nullptr);
    targets_.motion = facts_.motion;
    targets_.motion_format = facts_.motion_format;
    if (o.rays || o.reference > 0) {
        auto heap = make_texel_heap(input.drawn.get().textures);
        if (!heap)
            throw error(std::string(heap.error().reason()));
        heap_ = std::move(*heap);
    }
}

tools::frustum temporal_frames::frustum_of(const tools::camera& c) const
{
    return choose_frustum(options_, c, range_, distance_);
}

ray_view temporal_frames::view_of(const tools::camera& c) const
{
    const auto folded =
        fold_projection(make_view(options_, c, frustum_of(c)).effect.projection, options_.size.width, options_.size.height);
    if (!folded)
        throw error(std::string(folded.error().reason()));
    return { c, *folded };
}

void temporal_frames::advance()
{
    ++frame_;
    before_ = moves_.previous_camera(frame_);
    camera_ = moves_.camera_at(frame_);
    frustum_ = frustum_of(camera_);
    moves_.move(input_.drawn.objects(), frame_);
    if (options_.rays || options_.reference > 0)
        trace();
}

ao::gbuffer_camera temporal_frames::drawing() const
{
    ao::gbuffer_camera c = make_view(options_, camera_, frustum_).drawing;
    const ao::gbuffer_camera before = make_view(options_, before_, frustum_of(before_)).drawing;
    c.previous_projection = before.projection;
    c.previous_view = before.view;
    return c;
}

ao::temporal_camera temporal_frames::effect() const
{
    ao::temporal_camera c;
    c.projection = make_view(options_, camera_, frustum_).effect.projection;
    const glm::mat4 view = view_matrix(camera_);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            c.world_to_view[column][row] = view[column][row];
    for (int i = 0; i < 3; ++i)
        c.eye[static_cast<std::size_t>(i)] = static_cast<double>(camera_.eye[i]);
    return c;
}

void temporal_frames::trace()
{
    // Nothing moves: the same rays would see the same.
    if (frame_ > 0 && !moves_.moves_objects() && same(camera_, before_))
        return;
    std::optional<tools::scene> moved;
    if (moves_.moves_objects())
        moved = moves_.moved(input_.model, frame_);
    const tools::scene& seen = moved ? *moved : input_.model;
    if (!tree_ || moved)
        tree_.emplace(seen);
    rays_ = trace_gbuffer(seen, *tree_, camera_, frustum_, options_.size.width, options_.size.height);
    // So that the truth is of the normals that the effect sees.
    apply_normal_maps(*rays_, seen, input_.drawn.get(), heap_, camera_, frustum_);
    stop_if_interrupted();
    if (options_.rays)
        make_pictures(seen);
    if (options_.reference == 0)
        return;
    truth_ = trace_truth(seen, *tree_, camera_, *rays_, { options_.settings.radius, options_.reference, options_.settings.seed },
                         &interrupted());
    stop_if_interrupted();
}

void temporal_frames::make_pictures(const tools::scene& seen)
{
    const ao::facts& f = facts_.frame;
    const ao::camera_projection projection = make_view(options_, camera_, frustum_).effect.projection;
    picture_set drawn = pictures_of_rays(seen, input_.drawn.get(), *rays_, camera_, frustum_, targets_, projection);
    if (f.depth == depth_source::linear)
        pictures_.depth = pack_depth(rays_->depth, rays_->width, rays_->height, f.depth, f.depth_format, projection);
    else
        pictures_.depth =
            std::move(drawn[f.depth == depth_source::position ? host::scene_picture::position : host::scene_picture::depth]);
    pictures_.normal = std::move(drawn[host::scene_picture::normal]);
    if (facts_.motion)
        pictures_.motion = motion_of_rays(*rays_, view_of(camera_), view_of(before_), moves_, frame_);
}

} // namespace ao::tools
