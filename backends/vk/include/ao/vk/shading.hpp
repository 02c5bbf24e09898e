// Forward shading with ambient occlusion on Vulkan 1.1: the executor of ao/shading.hpp's plans, as compute passes recorded into
// a command buffer of the host's.
//
//     auto shading = ao::vk::shading::create({ instance, physical_device, device, vkGetInstanceProcAddr });
//     auto plan = ao::make_shade_plan(scene, facts, camera);
//     auto program = shading->prepare_shading(*plan, heap);        // ao::make_texel_heap(scene.textures)
//     auto bound = shading->bind_shading(*program, *plan, images);
//     ...
//     ao::update(*plan, camera);                                    // every frame
//     for (std::size_t i = 0; i < plan->passes.size(); ++i) shading->record_shading(commands, *program, *bound, *plan, i);
//
// What the pictures are: one level, one layer, one sample, of the plan's size, swizzle identity; as ao/vk/rasterizer.hpp writes
// them.
//   depth or position, normal    as in ao/vk/backend.hpp. Usage SAMPLED.
//   ids                          R32G32_UINT. Usage SAMPLED.
//   surface, frame               R32G32B32A32_SFLOAT, where shade_options::maps and ::frames say so. Usage SAMPLED.
//   visibility                   R32_SFLOAT, R8_UNORM or R16G16B16A16_SFLOAT, where shade_facts says so. Usage SAMPLED.
//   color                        R32G32B32A32_SFLOAT, linear. Usage STORAGE. Every pixel is written.
//
// What the host does around the passes:
//   before  the inputs are in the layout given to bind_shading() and their contents visible to SHADER_READ in the COMPUTE_SHADER
//           stage; color is in layout GENERAL and whatever used it last is ordered before SHADER_WRITE in the COMPUTE_SHADER
//           stage (from layout UNDEFINED is fine: no content is kept).
//   after   color, still in GENERAL, is visible to context::readers as the visibility is in ao/vk/backend.hpp. Anything else, a
//           layout transition too, takes a barrier from COMPUTE_SHADER, SHADER_WRITE. Writing the inputs again takes an execution
//           dependency on COMPUTE_SHADER.
// Outside a render pass, on a queue with compute. All passes of a frame go into the same queue in order; recording orders the
// program's own pictures, table and counter against their use by earlier frames in that queue; frames in flight on several queues
// need a program each. It changes the bound compute pipeline, the compute descriptor set 0 and the push constants, nothing else.
//
// Memory of a program: the table, the heap (in host-visible memory, the device's own where it has such), a counter, 16 bytes per
// pixel and target of the plan.
#pragma once

#include "ao/shading_backend.hpp"
#include "ao/vk/backend.hpp"

#include <memory>
#include <optional>

namespace ao::vk {

struct shade_program_state;
struct shade_binding_state;

// Pipelines, the table, the heap and the plan's targets.
class shade_program {
public:
    explicit shade_program(std::unique_ptr<shade_program_state> state);
    shade_program(shade_program&&) noexcept;
    shade_program& operator=(shade_program&&) noexcept;
    ~shade_program();

private:
    friend class shading;
    std::unique_ptr<shade_program_state> state_;
};

class shade_binding {
public:
    explicit shade_binding(std::unique_ptr<shade_binding_state> state);
    shade_binding(shade_binding&&) noexcept;
    shade_binding& operator=(shade_binding&&) noexcept;
    ~shade_binding();

private:
    friend class shading;
    std::unique_ptr<shade_binding_state> state_;
};

// One thread at a time per object; a binding is used with its own program, which outlives it.
class shading {
public:
    using image = vk::image;
    using commands = VkCommandBuffer;
    using shade_program = vk::shade_program;
    using shade_binding = vk::shade_binding;

    // Fails as backend::create does.
    static result<shading> create(const context& c);
    shading(shading&&) noexcept;
    shading& operator=(shading&&) noexcept;
    ~shading();

    // errc::unsupported_format, errc::invalid_size: the device cannot do what the plan asks for; errc::out_of_memory: a heap, a
    // table or targets beyond its limits.
    result<shade_program> prepare_shading(const shade_plan& p, const texel_heap& heap);
    // At any time: what is recorded already keeps the table it was recorded with. The change is in the command buffer that pass
    // 0 is recorded into next (vkCmdUpdateBuffer), which therefore runs, and before those recorded after it.
    // errc::plan_mismatch: a table of another size.
    std::optional<error> update_table(shade_program& program, const shade_plan& p);
    // The views must outlive the binding's use. errc::plan_mismatch: the program is for another plan; a view that the plan needs
    // is null, and which; color is not in layout GENERAL.
    result<shade_binding> bind_shading(shade_program& program, const shade_plan& p, const shade_images<image>& images);
    // Only records: no allocation, no lock, no failure.
    void record_shading(VkCommandBuffer commands, shade_program& program, shade_binding& bound, const shade_plan& p,
                        std::size_t index);
    // Modulo 2^32. What was recorded has run: its fence or queue was waited for.
    result<std::uint64_t> clamped_weights(shade_program& program);

private:
    explicit shading(std::unique_ptr<device> d);
    std::unique_ptr<device> device_;
};

static_assert(shading_backend<shading>);

} // namespace ao::vk
