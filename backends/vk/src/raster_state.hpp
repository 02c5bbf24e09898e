// What models and targets of the rasterizer hold.
#pragma once

#include "ao/drawing.hpp"
#include "ao/vk/rasterizer.hpp"
#include "memory.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace ao::vk {

inline constexpr std::size_t target_count = 6; // by location in shaders/geometry.frag

struct raster_target {
    const char* role;
    pixel_format format;
    bool wanted;
};

// By location. Attachments are those that are wanted, in this order.
std::array<raster_target, target_count> targets_of(const gbuffer_facts& f);
std::vector<VkFormat> color_formats(const gbuffer_facts& f);

// Descriptors of set 0 by binding.
enum raster_slot : std::uint32_t {
    camera_slot,
    instances_slot,
    previous_slot,
    materials_slot,
    raster_heap_slot,
    raster_slot_count
};

// The maps of a batch, with the device's sampler: set 1.
struct sampled_maps {
    owned<VkDescriptorPool> pool;
    std::vector<VkDescriptorSet> sets;        // by batch; null where it reads no maps
    std::array<owned<VkSampler>, 9> samplers; // by wrap modes, 3 * v + u
    std::vector<picture> pictures;            // by place
    std::vector<VkBufferImageCopy> copies;    // of all pictures' levels,
    std::vector<std::uint32_t> copies_of;     // the number of each picture's
    buffer texels;                            // and what they copy from
    bool uploaded = false;                    // recorded
};

// Objects' transforms on their way to the tables.
struct moved_objects {
    std::vector<buffer> pieces; // raster_options::moves_in_flight of them, made when they are first needed
    std::size_t next = 0;
    std::size_t ready = 0; // the piece to be copied,
    bool waiting = false;  // at the next recording
};

struct raster_model_state {
    gbuffer_facts facts;
    std::vector<draw_variant> variants;

    std::vector<owned<VkPipeline>> pipelines;
    std::vector<std::size_t> first_pipeline; // by variant; one, or four by pipeline_state
    std::size_t programs = 0;
    owned<VkDescriptorSetLayout> set_layout;
    owned<VkDescriptorSetLayout> maps_layout;
    owned<VkPipelineLayout> layout;
    owned<VkRenderPass> pass; // what the pipelines are made for, without dynamic rendering
    owned<VkDescriptorPool> pool;
    VkDescriptorSet set = VK_NULL_HANDLE;

    indirect_draws draws;
    std::size_t draw_calls = 0;
    std::vector<drawn_object> objects; // by slot
    std::size_t scene_objects = 0;

    std::array<buffer, vertex_attribute_count> attributes; // those that no variant reads are null
    buffer indices;
    buffer indirect; // where draws are indirect
    buffer camera;
    buffer instances;
    buffer previous; // for motion
    buffer materials;
    buffer heap;
    sampled_maps maps;
    moved_objects moved;
};

struct raster_targets_state {
    std::vector<image> colors; // by attachment
    image depth;
    owned<VkRenderPass> pass; // without dynamic rendering
    owned<VkFramebuffer> framebuffer;
};

// Which of a variant's four pipelines, where state is not dynamic.
constexpr std::size_t pipeline_state(bool clockwise, bool reversed)
{
    return (clockwise ? 1U : 0U) + (reversed ? 2U : 0U);
}

bool draws_indirectly(const device& d);

// A render pass that clears and stores every attachment: colors, then depth. They stay in the layouts of `targets`, or, where
// only pipelines are made for it, null, in any.
result<owned<VkRenderPass>> make_render_pass(const device& d, const gbuffer_facts& f, const raster_targets_state* targets);

std::optional<error> make_layouts(const device& d, bool hardware, raster_model_state& made);

// Fills layouts, pass, programs and pipelines.
std::optional<error> make_pipelines(const device& d, sampling how, const draw_plan& p, raster_model_state& into);

// Fills `maps`. Precondition: draws and maps_layout are made.
std::optional<error> make_sampled_maps(const device& d, const scene& s, const map_places& found, raster_model_state& into);
void upload_maps(const device& d, VkCommandBuffer commands, sampled_maps& maps);

} // namespace ao::vk
