#include "ao/vk/bake.hpp"

#include "ao_vk_shaders.hpp"
#include "bake_state.hpp"
#include "pipeline.hpp"

#include <algorithm>
#include <new>
#include <utility>

namespace ao::vk {

baker::baker(std::unique_ptr<bake_state> state) : state_(std::move(state)) {}
baker::baker(baker&&) noexcept = default;
baker& baker::operator=(baker&&) noexcept = default;
baker::~baker() = default;

namespace {

constexpr std::uint32_t most_invocations = 256; // whose tile every device holds

std::optional<error> make_layouts(bake_state& made)
{
    const device& d = *made.on;
    std::array<VkDescriptorSetLayoutBinding, bake_slot_count> bindings{};
    for (std::uint32_t i = 0; i < bake_slot_count; ++i) {
        const VkDescriptorType type = i < sums_slot ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        bindings[i] = { i, type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr };
    }
    VkDescriptorSetLayoutCreateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set.bindingCount = bake_slot_count;
    set.pBindings = bindings.data();
    AO_VK_CREATE(made.set_layout, d, DescriptorSetLayout, set);

    const VkPushConstantRange range{ VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(detail::bake_launch) };
    const VkDescriptorSetLayout set_layout = made.set_layout.get();
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_layout;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &range;
    AO_VK_CREATE(made.layout, d, PipelineLayout, layout);
    return std::nullopt;
}

std::span<const std::uint32_t> code_of(detail::bake_shader shader)
{
    switch (shader) {
    case detail::bake_shader::brute:
        return shaders::bake_brute_comp;
    case detail::bake_shader::tiled:
        return shaders::bake_tiled_comp;
    case detail::bake_shader::hierarchy:
        return shaders::bake_hierarchy_comp;
    case detail::bake_shader::project:
        return shaders::bake_project_comp;
    case detail::bake_shader::packed:
        return shaders::bake_packed_comp;
    case detail::bake_shader::raster_sort:
        return shaders::bake_raster_sort_comp;
    case detail::bake_shader::raster_cover:
        return shaders::bake_raster_cover_comp;
    case detail::bake_shader::cube_clear:
        return shaders::bake_cube_clear_comp;
    case detail::bake_shader::cube_depth:
        return shaders::bake_cube_depth_comp;
    case detail::bake_shader::cube_count:
        return shaders::bake_cube_count_comp;
    case detail::bake_shader::count_packed:
        break;
    }
    return shaders::bake_count_packed_comp;
}

} // namespace

result<VkPipeline> bake_pipeline_of(bake_state& state, detail::bake_shader shader,
                                    const std::array<std::uint32_t, detail::bake_gpu_constants>& constants)
{
    for (const bake_pipeline& each : state.pipelines) {
        if (each.shader == shader && each.constants == constants) {
            return each.pipeline.get();
        }
    }
    std::array<specialisation_value, detail::bake_gpu_constants> values{};
    for (std::uint32_t i = 0; i < values.size(); ++i) {
        values[i] = { i, constants[i] };
    }
    auto made = make_compute_pipeline(*state.on, code_of(shader), values, state.layout.get());
    if (!made) {
        return made.error();
    }
    state.pipelines.push_back({ shader, constants, std::move(*made) });
    return state.pipelines.back().pipeline.get();
}

result<baker> baker::create(const context& c, const compute_queue& queue, const bake_gpu_options& options)
{
    auto on = make_device(c);
    if (!on) {
        return on.error();
    }
    auto submit = submitter::create(**on, queue);
    if (!submit) {
        return submit.error();
    }
    std::unique_ptr<bake_state> state(new (std::nothrow) bake_state);
    if (!state) {
        return error(errc::out_of_memory, "out of memory");
    }
    state->on = std::move(*on);
    state->submit = std::move(*submit);
    state->options = options;
    const VkPhysicalDeviceLimits& limits = state->on->properties.limits;
    state->group =
        std::min({ state->on->host.group.x * state->on->host.group.y, most_invocations, limits.maxComputeWorkGroupSize[0] });
    if (const auto wrong = make_layouts(*state)) {
        return *wrong;
    }
    return baker(std::move(state));
}

result<bake_sums> baker::run(const bake_job& job, const bake_request& request)
{
    bake_state& state = *state_;
    const auto part = checked_request(job, request);
    if (!part) {
        return part.error();
    }
    const auto chosen = detail::choose_bake_gpu_route(job, *part);
    if (!chosen) {
        return chosen.error();
    }
    const bake_route route = chosen->route;
    bake_sums sums = detail::empty_bake_sums(*part, *chosen);
    if (detail::nothing_to_bake(job, *part)) {
        return sums;
    }
    const detail::bake_room room = detail::bake_room_of(job, *part, route, state.options);
    const std::uint32_t group = detail::bake_group_of(route, state.group);
    const auto constants = detail::bake_gpu_constants_of(job, group);
    for (const detail::bake_shader shader : detail::bake_shaders_of(route)) {
        if (const auto pipeline = bake_pipeline_of(state, shader, constants); !pipeline) {
            return pipeline.error();
        }
    }
    bake_buffers buffers;
    if (const auto wrong = make_bake_buffers(state, job, *part, route, room, buffers)) {
        return *wrong;
    }
    const device& d = *state.on;
    const auto execute = [&](detail::bake_shader shader, const detail::bake_launch& launch, std::uint32_t x,
                             std::uint32_t y) -> std::optional<error> {
        const auto pipeline = bake_pipeline_of(state, shader, constants);
        if (!pipeline) {
            return pipeline.error();
        }
        return state.submit.run([&](VkCommandBuffer commands) {
            d.call.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, *pipeline);
            d.call.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, state.layout.get(), 0, 1, &buffers.set, 0,
                                         nullptr);
            d.call.CmdPushConstants(commands, state.layout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof launch, &launch);
            d.call.CmdDispatch(commands, x, y, 1);
        });
    };
    detail::bake_gpu_driver driver(job, *part, route, state.options, room, group, execute);
    const auto end = driver.run();
    if (!end) {
        return end.error();
    }
    sums.last_vertex = end->last_vertex;
    sums.last_line = end->last_line;
    sums.sums.resize(sums.last_vertex - sums.first_vertex);
    if (const auto wrong = read_bake_sums(state, buffers, sums.sums)) {
        return *wrong;
    }
    return sums;
}

} // namespace ao::vk
