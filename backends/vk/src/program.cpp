#include "program.hpp"

#include "ao_vk_shaders.hpp"
#include "pipeline.hpp"
#include "support.hpp"

#include <new>

namespace ao::vk {

namespace {

// The builds of one source: for storing to r32f and r8, for GPUs and for CPUs.
struct shader_family {
    std::span<const std::uint32_t> plain, r8, software, software_r8;
};

std::span<const std::uint32_t> shader_of(const device& d, const pass& each, const plan& p)
{
    using namespace shaders;
    const bool r8 = each.output == image_id::visibility && p.facts.output_format == pixel_format::r8;
    const bool stored = is_stored(d, each);
    const auto pick = [&](const shader_family& f) { return stored ? (r8 ? f.software_r8 : f.software) : (r8 ? f.r8 : f.plain); };
    switch (each.type) {
    case pass_type::linearize:
        return linearize_comp;
    case pass_type::occlusion:
        return pick({ occlusion_comp, occlusion_comp_r8, occlusion_comp_software, occlusion_comp_software_r8 });
    case pass_type::filter_rows:
        return stored ? filter_rows_comp_software : filter_rows_comp;
    case pass_type::filter_columns:
        return pick(
            { filter_columns_comp, filter_columns_comp_r8, filter_columns_comp_software, filter_columns_comp_software_r8 });
    case pass_type::bitmask:
        if (each.options.bent_normal && each.options.mark_background) {
            return stored ? bitmask_comp_software_bent_packed : bitmask_comp_bent_packed;
        }
        if (each.options.bent_normal) {
            return stored ? bitmask_comp_software_bent : bitmask_comp_bent;
        }
        if (each.options.mark_background) {
            return stored ? bitmask_comp_software_packed : bitmask_comp_packed;
        }
        return pick({ bitmask_comp, bitmask_comp_r8, bitmask_comp_software, bitmask_comp_software_r8 });
    case pass_type::denoise_rows:
        if (each.options.bent_normal) {
            return stored ? denoise_rows_comp_software_bent : denoise_rows_comp_bent;
        }
        return stored ? denoise_rows_comp_software : denoise_rows_comp;
    case pass_type::denoise_columns:
        if (each.options.bent_normal) {
            return stored ? denoise_columns_comp_software_bent : denoise_columns_comp_bent;
        }
        return pick(
            { denoise_columns_comp, denoise_columns_comp_r8, denoise_columns_comp_software, denoise_columns_comp_software_r8 });
    }
    return {};
}

result<owned<VkPipeline>> make_pipeline(const device& d, const plan& p, const pass& each, VkPipelineLayout layout)
{
    const pass_options& o = each.options;
    const std::array<specialisation_value, 13> values{ { { 0, o.affine },
                                                         { 1, static_cast<std::uint32_t>(o.tap_count) },
                                                         { 2, static_cast<std::uint32_t>(o.normal_source) },
                                                         { 3, o.rotate_normals },
                                                         { 4, o.parallel },
                                                         { 5, o.limit_thickness },
                                                         { 6, o.mark_background },
                                                         { 7, static_cast<std::uint32_t>(o.filter_radius) },
                                                         { 8, p.facts.depth == depth_source::position },
                                                         { 9, static_cast<std::uint32_t>(o.slice_count) },
                                                         { 10, d.host.group.x },
                                                         { 11, d.host.group.y },
                                                         { 12, o.coarse } } };
    return make_compute_pipeline(d, shader_of(d, each, p), values, layout);
}

std::optional<error> make_layouts(const device& d, prepared& made)
{
    constexpr std::array<VkDescriptorType, 7> types{ VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,  VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,
                                                     VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER,
                                                     VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,  VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
                                                     VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE };
    std::array<VkDescriptorSetLayoutBinding, types.size()> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i) {
        bindings[i] = { i, types[i], 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr };
    }
    VkDescriptorSetLayoutCreateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set.pBindings = bindings.data();
    AO_VK_CREATE(made.set_layout, d, DescriptorSetLayout, set);

    const VkPushConstantRange range{ VK_SHADER_STAGE_COMPUTE_BIT, 0, 128 };
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

} // namespace

bool is_stored(const device& d, const pass& each)
{
    return is_software(d) && each.inputs[0] != image_id::depth;
}

linearize_constants copying_constants()
{
    linearize_constants identity{};
    identity.scale = 1;
    identity.background = std::numeric_limits<float>::infinity();
    return identity;
}

plan executed_plan(const device& d, const plan& p)
{
    if (!is_software(d) || p.facts.depth != depth_source::linear || p.settings.resolution == resolution::half) {
        return p;
    }
    plan executed = p;
    executed.passes = {};
    pass copy;
    copy.type = pass_type::linearize;
    copy.options.affine = true;
    copy.inputs[0] = image_id::depth;
    copy.output = image_id::linear_depth;
    ao::detail::set_constants(copy, copying_constants());
    executed.passes.push_back(copy);
    executed.transients.push_back({ image_id::linear_depth, pixel_format::r32f, p.facts.width, p.facts.height });
    for (pass each : p.passes) {
        for (image_id& input : each.inputs) {
            input = input == image_id::depth ? image_id::linear_depth : input;
        }
        executed.passes.push_back(each);
    }
    return executed;
}

std::optional<error> unsupported(const device& d, const plan& p)
{
    if (const auto wrong = wrong_size(d, p.facts.width, p.facts.height)) {
        return wrong;
    }
    if (!can_sample(d, p.facts.depth_format)) {
        return lacks("sample", p.facts.depth_format);
    }
    if (p.facts.normals != normal_source::from_depth && !can_sample(d, p.facts.normal_format)) {
        return lacks("sample", p.facts.normal_format);
    }
    if (!can_store(d, p.facts.output_format)) {
        return lacks("store to", p.facts.output_format);
    }
    for (const transient_image& each : p.transients) {
        if (!can_sample(d, each.format)) {
            return lacks("sample", each.format);
        }
        if (!can_store(d, each.format)) {
            return lacks("store to", each.format);
        }
    }
    return std::nullopt;
}

result<program> backend::prepare(const plan& p)
{
    const device& d = *device_;
    const plan executed = executed_plan(d, p);
    if (const auto wrong = unsupported(d, executed)) {
        return *wrong;
    }
    std::unique_ptr<prepared> made(new (std::nothrow) prepared);
    if (!made) {
        return error(errc::out_of_memory, "out of memory");
    }
    made->given = p;
    made->executed = executed;
    auto own_tables = make_tables(d, executed);
    if (!own_tables) {
        return own_tables.error();
    }
    made->tables = std::move(*own_tables);
    auto pictures = make_transients(d, executed);
    if (!pictures) {
        return pictures.error();
    }
    made->transients = std::move(*pictures);
    if (const auto wrong = make_layouts(d, *made)) {
        return *wrong;
    }
    for (std::size_t i = 0; i < executed.passes.size(); ++i) {
        auto pipeline = make_pipeline(d, executed, executed.passes[i], made->layout.get());
        if (!pipeline) {
            return pipeline.error();
        }
        made->pipelines[i] = std::move(*pipeline);
    }
    return program(std::move(made));
}

} // namespace ao::vk
