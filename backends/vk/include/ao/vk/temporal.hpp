// Temporal ambient occlusion on Vulkan 1.1: the executor of ao/temporal.hpp's plans, as compute passes recorded into a command
// buffer of the host's.
//
//     auto temporal = ao::vk::temporal::create({ instance, physical_device, device, vkGetInstanceProcAddr });
//     auto effect = ao::temporal_effect<ao::vk::temporal>::create(*temporal, settings, facts);
//     auto bound = effect->bind({ { depth_view, layout }, { normal_view, layout }, { motion_view, layout }, { visibility_view }
//     });
//     ...
//     effect->record(command_buffer, *bound, camera);              // every frame
//
// What the pictures are: depth, normal and visibility as in ao/vk/backend.hpp.
//   motion      R32G32_SFLOAT, R16G16B16A16_SFLOAT or R32G32B32A32_SFLOAT, one level, one layer, one sample, of the plan's size,
//               swizzle identity. Usage SAMPLED. Not looked at (may be null) where temporal_facts::motion is false.
//
// What the host does around a frame's steps: as in ao/vk/backend.hpp, motion as depth and normal. A frame without steps records
// nothing. Outside a render pass, on a queue with compute. All steps of a frame, and the frames in their order, go into the same
// queue; recording orders the histories, the constants and the program's own pictures against their use by earlier frames there,
// whether they have run or not: nothing needs to be waited for. It changes the bound compute pipeline, the compute descriptor set
// 0 and the push constants, nothing else.
//
// Histories are the program's own; before the first frame their content is undefined. Copies from and to them in the same queue
// are ordered before the frames recorded after them. To copy one out, a barrier from COMPUTE_SHADER, SHADER_WRITE goes before
// (none where context::readers has TRANSFER and the frame has steps).
//
// Device features: shaderStorageImageExtendedFormats where the output is R8_UNORM.
// Memory of a program, bytes per pixel: twice 16 (precise) or 8 of history, 4 unless depth is linear, 4 with a filter; besides,
// 32 KiB and 16 bytes per sample of the period. On devices that are CPUs linear depth takes 4 too.
#pragma once

#include "ao/temporal_backend.hpp"
#include "ao/vk/backend.hpp"

#include <memory>

namespace ao::vk {

struct temporal_program_state;
struct temporal_binding_state;

// Pipelines, tables, own pictures and the two histories.
class temporal_program {
public:
    explicit temporal_program(std::unique_ptr<temporal_program_state> state);
    temporal_program(temporal_program&&) noexcept;
    temporal_program& operator=(temporal_program&&) noexcept;
    ~temporal_program();

    // 0 or 1, as temporal_frame::read and ::write say: history_bytes(plan) bytes, usage TRANSFER_SRC and TRANSFER_DST.
    VkBuffer history(int which) const;

private:
    friend class temporal;
    std::unique_ptr<temporal_program_state> state_;
};

class temporal_binding {
public:
    explicit temporal_binding(std::unique_ptr<temporal_binding_state> state);
    temporal_binding(temporal_binding&&) noexcept;
    temporal_binding& operator=(temporal_binding&&) noexcept;
    ~temporal_binding();

private:
    friend class temporal;
    std::unique_ptr<temporal_binding_state> state_;
};

// fulfils ao::temporal_backend. One thread at a time per object; a binding is used with its own program, which outlives it.
class temporal {
public:
    using image = vk::image;
    using commands = VkCommandBuffer;
    using temporal_program = vk::temporal_program;
    using temporal_binding = vk::temporal_binding;

    // Fails as backend::create does.
    static result<temporal> create(const context& c);
    temporal(temporal&&) noexcept;
    temporal& operator=(temporal&&) noexcept;
    ~temporal();

    // errc::unsupported_format, errc::invalid_size: the device cannot do what the plan asks for; errc::out_of_memory: a history
    // beyond what it can bind.
    result<temporal_program> prepare_temporal(const temporal_plan& p);
    // The views must outlive the binding's use. errc::plan_mismatch: the program is for plans of another structure; a view that
    // the plan needs is null, and which; visibility is not in layout GENERAL.
    result<temporal_binding> bind_temporal(temporal_program& program, const temporal_plan& p,
                                           const temporal_images<image>& images);
    // Only records: no allocation, no lock, no failure.
    void record_temporal(VkCommandBuffer commands, temporal_program& program, temporal_binding& bound, const temporal_plan& p,
                         const temporal_frame& frame, std::size_t index);

private:
    explicit temporal(std::unique_ptr<device> d);
    std::unique_ptr<device> device_;
};

static_assert(temporal_backend<temporal>);

} // namespace ao::vk
