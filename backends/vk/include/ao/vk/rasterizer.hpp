// The geometry pass (ao/gbuffer.hpp) on Vulkan 1.1, recorded into a command buffer of the host's.
//
//     auto vk = ao::vk::rasterizer::create({ instance, physical_device, device, vkGetInstanceProcAddr });
//     auto plan = ao::plan_drawing(scene, facts);
//     auto model = vk->load(scene, *plan);                          // the scene's memory may go, but for its objects
//     auto targets = vk->bind(*model, images);
//     vk->move(*model, scene);                                      // when objects moved
//     vk->record(commands, *model, *targets, camera);               // each frame
//
// What the pictures are: one level, one layer, one sample, of the plan's size. depth: D32_SFLOAT (d32f) or X8_D24_UNORM_PACK32
// (d24), usage DEPTH_STENCIL_ATTACHMENT. The others, usage COLOR_ATTACHMENT, as gbuffer_facts says: position R32G32B32A32_SFLOAT
// or R16G16B16A16_SFLOAT; normal R16G16B16A16_SFLOAT, R32G32B32A32_SFLOAT, A2B10G10R10_UNORM_PACK32 or R16G16_UNORM; motion
// R32G32_SFLOAT or R32G32B32A32_SFLOAT; ids R32G32_UINT; surface and frame R32G32B32A32_SFLOAT. What the plan leaves out is not
// looked at.
//
// What the host does around record():
//   before  the pictures are in the layouts given to bind(): GENERAL, or COLOR_ATTACHMENT_OPTIMAL, for depth
//           DEPTH_STENCIL_ATTACHMENT_OPTIMAL (from layout UNDEFINED is fine: no content is kept), and whatever used them last is
//           ordered before COLOR_ATTACHMENT_WRITE in COLOR_ATTACHMENT_OUTPUT, for depth before DEPTH_STENCIL_ATTACHMENT_WRITE in
//           EARLY_FRAGMENT_TESTS.
//   after   the pictures, still in these layouts, are visible to context::readers as the visibility is in ao/vk/backend.hpp.
//           Anything else, a layout transition too, takes a barrier from COLOR_ATTACHMENT_OUTPUT, COLOR_ATTACHMENT_WRITE and
//           LATE_FRAGMENT_TESTS, DEPTH_STENCIL_ATTACHMENT_WRITE.
// Outside a render pass, on a queue with graphics. Recording orders the model's own buffers against their use by earlier frames
// in the same queue; frames in flight on several queues need a model each. It changes the bound graphics pipeline, the graphics
// descriptor sets 0 and 1, the index buffer and vertex buffers 0 to 4, with enabled_features::extended_dynamic_state the cull
// mode, front face and depth comparison, nothing else.
//
// Projection: any that fold_projection takes, of either depth range, Y up or down; the first row in memory shows the end of NDC y
// that camera_projection::rows names, by turning y around where that is +1. Depth is stored from 0 to 1, cleared to the far end
// and compared with less, or greater where that is 0. Of surfaces at equal depth the first in the plan's order stays.
// Precondition of record: both projections are supported. Motion of points that were behind the eye means nothing.
//
// Normals and tangents are interpolated as the matrices leave them, not normalised in between, and bitangents turn around under
// models that mirror. Footprints come from differences within 2x2 pixels.
//
// Draws: one shader for each need of the plan's variants; one multi-draw for each variant, or each variant and material with the
// device's sampler; objects in a row that share mesh and variant are instances. With enabled_features::extended_dynamic_state a
// shader takes one pipeline, else four for each of its cull modes, since sides and the direction of depth depend on the camera.
// Dynamic rendering where enabled_features has it, else a render pass and a framebuffer per targets: the same picture.
//
// Memory, visible to the host, the device's own where it has such: vertices in arrays over all meshes, position 12 bytes, and
// where some variant reads them normal 12, tangent 16, uv 8, previous position 12 bytes per vertex; meshes without normals three
// vertices per triangle; 4 bytes per index; 64 bytes per object, 48 more for motion, 20 per draw; and once objects move
// raster_options::moves_in_flight times 64 (112) bytes per object. Textures: alpha and normal maps only; with the device's
// sampler twice, since what they are copied from stays.
#pragma once

#include "ao/gbuffer.hpp"
#include "ao/vk/backend.hpp"

#include <cstddef>
#include <memory>
#include <optional>

namespace ao::vk {

enum class sampling {
    shared,   // trilinear by ao/shared/texture.h: the same texels and weights on every backend
    hardware, // trilinear by the device's sampler: faster on GPUs, weights in steps of 1/256 or so
};

struct raster_options {
    vk::sampling sampling = vk::sampling::shared; // of alpha and normal maps
    // How many calls of move() whose frames have not been waited for there may be at a time, with the new one. At least 1.
    int moves_in_flight = 3;
};

struct raster_model_state;
struct raster_targets_state;

// A scene uploaded, and the pipelines that its variants need.
class raster_model {
public:
    explicit raster_model(std::unique_ptr<raster_model_state> state);
    raster_model(raster_model&&) noexcept;
    raster_model& operator=(raster_model&&) noexcept;
    ~raster_model();

    std::size_t programs() const;   // shaders: the needs of the variants
    std::size_t pipelines() const;  // programs, with the states that are not set while recording
    std::size_t draw_calls() const; // commands; those of one multi-draw count as one

private:
    friend class rasterizer;
    std::unique_ptr<raster_model_state> state_;
};

// The host's pictures as attachments.
class raster_targets {
public:
    explicit raster_targets(std::unique_ptr<raster_targets_state> state);
    raster_targets(raster_targets&&) noexcept;
    raster_targets& operator=(raster_targets&&) noexcept;
    ~raster_targets();

private:
    friend class rasterizer;
    std::unique_ptr<raster_targets_state> state_;
};

// One thread at a time per object; targets are used with their own model, which outlives them.
class rasterizer {
public:
    using image = vk::image;
    using commands = VkCommandBuffer;
    using model = raster_model;
    using targets = raster_targets;

    // Fails as backend::create does.
    static result<rasterizer> create(const context& c, const raster_options& chosen = {});
    rasterizer(rasterizer&&) noexcept;
    rasterizer& operator=(rasterizer&&) noexcept;
    ~rasterizer();

    // errc::invalid_size: a picture, mesh or texture beyond the device's limits; errc::unsupported_format: one that the device
    // does not draw to; errc::out_of_memory; errc::device. With the device's sampler the command buffer that the model is first
    // recorded into copies the textures, which therefore runs, and before those recorded after it.
    // Precondition: the plan was made from the scene.
    result<model> load(const scene& s, const draw_plan& p);
    // What is recorded already draws the objects where they were. The command buffer that the model is recorded into next copies
    // the transforms, which therefore runs, and before those recorded after it. Allocates at the first calls.
    // errc::plan_mismatch: other objects than those loaded, or one that mirrors now and did not, or the other way round;
    // errc::invalid_scene: a matrix that is not finite.
    std::optional<error> move(model& loaded, const scene& s);
    // The views must outlive the targets' use. errc::plan_mismatch: a view that the plan needs is null or its layout is none of
    // those above, and which.
    result<targets> bind(model& loaded, const gbuffer_images<image>& images);
    // Only records: no allocation, no lock, no failure.
    void record(VkCommandBuffer commands, model& loaded, targets& bound, const gbuffer_camera& camera);

private:
    rasterizer(std::unique_ptr<device> d, const raster_options& chosen);
    std::unique_ptr<device> device_;
    raster_options options_;
};

static_assert(ao::rasterizer<rasterizer>);

} // namespace ao::vk
