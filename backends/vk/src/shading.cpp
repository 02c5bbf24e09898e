#include "ao_vk_shaders.hpp"
#include "pipeline.hpp"
#include "shading_state.hpp"
#include "support.hpp"

#include <algorithm>
#include <cstdio>
#include <new>
#include <utility>

namespace ao::vk {

shade_program::shade_program(std::unique_ptr<shade_program_state> state) : state_(std::move(state)) {}
shade_program::shade_program(shade_program&&) noexcept = default;
shade_program& shade_program::operator=(shade_program&&) noexcept = default;
shade_program::~shade_program() = default;

shade_binding::shade_binding(std::unique_ptr<shade_binding_state> state) : state_(std::move(state)) {}
shade_binding::shade_binding(shade_binding&&) noexcept = default;
shade_binding& shade_binding::operator=(shade_binding&&) noexcept = default;
shade_binding::~shade_binding() = default;

shading::shading(std::unique_ptr<device> d) : device_(std::move(d)) {}
shading::shading(shading&&) noexcept = default;
shading& shading::operator=(shading&&) noexcept = default;
shading::~shading() = default;

result<shading> shading::create(const context& c)
{
    auto made = make_device(c);
    if (!made) {
        return made.error();
    }
    return shading(std::move(*made));
}

namespace {

std::optional<error> unsupported(const device& d, const shade_plan& p)
{
    const shade_facts& f = p.facts;
    if (const auto wrong = wrong_size(d, f.width, f.height)) {
        return wrong;
    }
    if (p.targets > static_cast<int>(d.properties.limits.maxImageArrayLayers)) {
        char text[128];
        std::snprintf(text, sizeof text, "a blend needs %d pictures, the Vulkan device has %u layers", p.targets,
                      d.properties.limits.maxImageArrayLayers);
        return error(errc::out_of_memory, text);
    }
    const auto check = [&](pixel_format format) {
        return can_sample(d, format) ? std::nullopt : std::optional(lacks("sample", format));
    };
    if (const auto wrong = check(f.stored_position ? f.position_format : f.depth_format)) {
        return wrong;
    }
    if (const auto wrong = check(f.normal_format)) {
        return wrong;
    }
    if (const auto wrong = check(pixel_format::rg32ui)) {
        return wrong;
    }
    if (const auto wrong = check(pixel_format::rgba32f)) {
        return wrong;
    }
    if (f.visibility) {
        if (const auto wrong = check(f.visibility_format)) {
            return wrong;
        }
    }
    if (!can_store(d, pixel_format::rgba32f)) {
        return lacks("store to", pixel_format::rgba32f);
    }
    return std::nullopt;
}

VkDescriptorType type_of(std::uint32_t slot)
{
    return slot < shade_inputs ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE
           : slot < table_slot ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE
                               : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

std::optional<error> make_layouts(const device& d, shade_program_state& made)
{
    std::array<VkDescriptorSetLayoutBinding, shade_slot_count> bindings{};
    for (std::uint32_t i = 0; i < shade_slot_count; ++i) {
        bindings[i] = { i, type_of(i), 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr };
    }
    VkDescriptorSetLayoutCreateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set.bindingCount = shade_slot_count;
    set.pBindings = bindings.data();
    AO_VK_CREATE(made.set_layout, d, DescriptorSetLayout, set);

    const VkPushConstantRange range{ VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(shade_constants) };
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

std::optional<error> make_pipelines(const device& d, const shade_plan& p, shade_program_state& made)
{
    const shade_options& o = p.options;
    const std::array<specialisation_value, 13> values{ { { 0, o.stored_position },
                                                         { 1, o.parallel },
                                                         { 2, static_cast<std::uint32_t>(o.normal_source) },
                                                         { 3, o.visibility },
                                                         { 4, o.maps },
                                                         { 5, o.reflections },
                                                         { 6, o.frames },
                                                         { 7, o.blends },
                                                         { 8, p.facts.visibility_format == pixel_format::r8 },
                                                         { 9, d.host.group.x },
                                                         { 10, d.host.group.y },
                                                         { 11, o.bent_normal },
                                                         { 12, o.multi_bounce } } };
    for (const shade_pass& each : p.passes) {
        const bool whole = each.type == shade_pass_type::shade;
        owned<VkPipeline>& pipeline = whole ? made.shade : made.segment;
        if (pipeline.get() == VK_NULL_HANDLE) {
            auto compiled =
                make_compute_pipeline(d, whole ? shaders::shade_comp : shaders::segment_comp, values, made.layout.get());
            if (!compiled) {
                return compiled.error();
            }
            pipeline = std::move(*compiled);
        }
    }
    return std::nullopt;
}

std::optional<error> make_tables(const device& d, const shade_plan& p, const texel_heap& heap, shade_program_state& made)
{
    const bool reads_heap = p.options.maps || p.options.reflections;
    const std::array<std::uint32_t, 1> zero{};
    const auto table = [&](buffer& to, const char* what, std::span<const std::uint32_t> words, VkBufferUsageFlags more) {
        auto own = make_table(d, what, std::as_bytes(words), more);
        if (own) {
            to = std::move(*own);
        }
        return own ? std::nullopt : std::optional(own.error());
    };
    if (const auto wrong = table(made.table, "the table of materials and blends", p.words, VK_BUFFER_USAGE_TRANSFER_DST_BIT)) {
        return wrong;
    }
    if (const auto wrong = table(made.heap, "the heap of textures",
                                 reads_heap ? std::span<const std::uint32_t>(heap.words) : std::span<const std::uint32_t>(), 0)) {
        return wrong;
    }
    return table(made.statistics, "a counter", zero, 0);
}

} // namespace

result<shade_program> shading::prepare_shading(const shade_plan& p, const texel_heap& heap)
{
    const device& d = *device_;
    if (const auto wrong = unsupported(d, p)) {
        return *wrong;
    }
    std::unique_ptr<shade_program_state> made(new (std::nothrow) shade_program_state);
    if (!made) {
        return error(errc::out_of_memory, "out of memory");
    }
    made->facts = p.facts;
    made->options = p.options;
    made->passes = p.passes.size();
    made->target_count = p.targets;
    made->words = p.words;
    if (const auto wrong = make_tables(d, p, heap, *made)) {
        return *wrong;
    }
    picture_shape shape;
    shape.format = VK_FORMAT_R32G32B32A32_SFLOAT;
    if (p.targets != 0) {
        shape.width = static_cast<std::uint32_t>(p.facts.width);
        shape.height = static_cast<std::uint32_t>(p.facts.height);
        shape.layers = static_cast<std::uint32_t>(p.targets);
    }
    shape.usage = VK_IMAGE_USAGE_STORAGE_BIT;
    shape.view = VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    auto targets = make_picture(d, shape);
    if (!targets) {
        return targets.error();
    }
    made->targets = std::move(*targets);
    if (const auto wrong = make_layouts(d, *made)) {
        return *wrong;
    }
    if (const auto wrong = make_pipelines(d, p, *made)) {
        return *wrong;
    }
    return shade_program(std::move(made));
}

std::optional<error> shading::update_table(shade_program& program, const shade_plan& p)
{
    shade_program_state& state = *program.state_;
    if (p.words.size() != state.words.size()) {
        return error(errc::plan_mismatch, "the table has another size than the prepared one");
    }
    for (std::size_t i = 0; i < p.words.size(); ++i) {
        if (p.words[i] != state.words[i]) {
            state.words[i] = p.words[i];
            const bool unchanged = state.changed_first == state.changed_end;
            state.changed_first = unchanged ? i : std::min(state.changed_first, i);
            state.changed_end = unchanged ? i + 1 : std::max(state.changed_end, i + 1);
        }
    }
    return std::nullopt;
}

result<std::uint64_t> shading::clamped_weights(shade_program& program)
{
    std::array<std::uint32_t, 1> count{};
    if (const auto wrong = read(*device_, program.state_->statistics, std::as_writable_bytes(std::span(count)))) {
        return *wrong;
    }
    return std::uint64_t{ count[0] };
}

} // namespace ao::vk
