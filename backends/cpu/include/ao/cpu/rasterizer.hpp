// The geometry pass (ao/gbuffer.hpp) on the CPU, drawn into pictures of the host's memory.
//
//     auto cpu = ao::cpu::rasterizer::create();
//     auto plan = ao::plan_drawing(scene, facts);
//     auto model = cpu->load(scene, *plan);                         // the scene's memory may go, but for its objects
//     auto targets = cpu->bind(*model, images);
//     cpu->move(*model, scene);                                     // when objects moved
//     cpu->record({}, *model, *targets, camera);                    // each frame
//
// Views have exactly the plan's width and height and at most 2^31 - 1 words of 4 bytes. depth: d32f, or d24 in the low 24 bits
// of a word whose upper 8 become 0. The others as gbuffer_facts says: position rgba32f or rgba16f, normal rgba16f, rgba32f,
// rgb10a2 (alpha 3) or rg16, motion rg32f or rgba32f, ids rg32ui, surface and frame rgba32f. What the plan leaves out is not
// looked at. Every pixel of every target is written. Targets may not overlap.
//
// Projection: any that fold_projection takes, of either depth range; the first row in memory shows the end of NDC y that
// camera_projection::rows names. Depth is cleared to the far end and compared with less, or greater where that is 0. Of surfaces
// at equal depth the first in the plan's order stays. Precondition of record: both projections are supported. Motion of points
// that were behind the eye means nothing.
//
// Coverage, as drivers do it: corners are clipped at the near and far plane and 16384 pixels beyond the picture, snapped to
// 1/256 of a pixel, and compared with pixel centres exactly in integers. A centre on an edge belongs to the triangle below it or
// to its right (rows as in memory), so that triangles sharing an edge share no pixel and leave none out. Depth is linear in the
// window and does not leave the range of the triangle's corners; attributes are perspective-correct at the pixel's centre;
// footprints come from differences within 2x2 pixels. Normals and tangents are interpolated as the matrices leave them. Triangles
// with a corner beyond 1e30 in clip space are not drawn.
//
// Memory of a model: positions 12 bytes, and where some variant reads them normals 12, tangents 16, uvs 8, previous positions 12
// per vertex; 6 bytes per index and 4 per vertex for clusters; 84 bytes per object, 48 more for motion; alpha and normal maps.
// Of targets: 12 bytes per pixel of a tile and thread; 72 bytes for each triangle in view and 12 for each tile that it touches,
// in arrays that grow when a view shows more than any before it: nothing else is allocated by record, other than tasks by oneTBB.
//
// record draws and returns when it is done; the calling thread works along. Calls may come from any thread, several at once for
// different targets. Assumes the default floating-point environment. Pictures are the same bits for every number of threads and
// tile size.
#pragma once

#include "ao/cpu/backend.hpp"
#include "ao/gbuffer.hpp"

#include <memory>
#include <optional>

namespace ao::cpu {

namespace detail {

struct threads;

} // namespace detail

struct raster_model_state;
struct raster_targets_state;

// A scene made ready to be drawn.
class raster_model {
public:
    raster_model(raster_model&&) noexcept;
    raster_model& operator=(raster_model&&) noexcept;
    ~raster_model();

private:
    friend class rasterizer;
    explicit raster_model(std::unique_ptr<raster_model_state> state);
    std::unique_ptr<raster_model_state> state_;
};

// Views of the host's pictures, and what a frame needs in between.
class raster_targets {
public:
    raster_targets(raster_targets&&) noexcept;
    raster_targets& operator=(raster_targets&&) noexcept;
    ~raster_targets();

private:
    friend class rasterizer;
    explicit raster_targets(std::unique_ptr<raster_targets_state> state);
    std::unique_ptr<raster_targets_state> state_;
};

class rasterizer {
public:
    using image = image_view;
    using commands = cpu::commands;
    using model = raster_model;
    using targets = raster_targets;

    // errc::invalid_settings for negative numbers; options::lanes is not looked at, tiles may be larger than asked for.
    static result<rasterizer> create(const options& o = {});

    rasterizer(rasterizer&&) noexcept;
    rasterizer& operator=(rasterizer&&) noexcept;
    ~rasterizer();

    // errc::out_of_memory. Precondition: the plan was made from the scene.
    result<model> load(const scene& s, const draw_plan& p);
    // errc::plan_mismatch: other objects than those loaded, or one that mirrors now and did not, or the other way round;
    // errc::invalid_scene: a matrix that is not finite.
    std::optional<error> move(model& loaded, const scene& s);
    // errc::unsupported_format, errc::invalid_size: a view that does not fit the plan, and which; errc::out_of_memory.
    result<targets> bind(model& loaded, const gbuffer_images<image>& images);
    void record(commands into, model& loaded, targets& bound, const gbuffer_camera& camera);

private:
    explicit rasterizer(std::unique_ptr<detail::threads> workers);
    std::unique_ptr<detail::threads> workers_;
};

static_assert(ao::rasterizer<rasterizer>);

} // namespace ao::cpu
