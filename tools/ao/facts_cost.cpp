#include "ao/facts_cost.hpp"

#include "scene/error.hpp"

#ifdef AO_HAS_VK
#include "ao_vk_shaders.hpp"
#include <spirv-tools/optimizer.hpp>
#endif

#include <algorithm>
#include <array>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace ao::tools {

pixel_cost& pixel_cost::operator+=(const pixel_cost& c)
{
    passes += c.passes;
    fetches += c.fetches;
    operations += c.operations;
    bytes += c.bytes;
    return *this;
}

#ifdef AO_HAS_VK
namespace {

using words = std::vector<std::uint32_t>;

// SPIR-V specification, 3.32 and 3.20.
enum : std::uint32_t {
    op_name = 5,
    op_ext_inst = 12,
    op_type_vector = 23,
    op_function = 54,
    op_decorate = 71,
    op_dot = 148,
    op_loop_merge = 246,
    op_label = 248,
    decoration_spec_id = 1,
    loop_unroll = 1,
    loop_dont_unroll = 2,
    header_words = 5
};

bool computes(std::uint32_t op)
{
    return (op >= 109 && op <= 115) || // conversions; a bitcast is free
           (op >= 126 && op <= 152) || // arithmetic
           (op >= 154 && op <= 191) || // logic and comparisons
           (op >= 194 && op <= 205) || // bits
           op == op_ext_inst;          // floor, sqrt, min, max ...
}

bool fetches(std::uint32_t op)
{
    return (op >= 87 && op <= 98) && op != 97; // samples, fetch, gather, read; 97 gathers with depth compare
}

// f(opcode, operands)
template <class Function>
void for_each_instruction(words& module, Function f)
{
    if (module.size() < header_words || module[0] != 0x07230203U)
        throw error("not a SPIR-V module");
    for (std::size_t at = header_words; at < module.size();) {
        const auto length = static_cast<std::size_t>(module[at] >> 16U);
        if (length == 0 || at + length > module.size())
            throw error("a SPIR-V module cut short");
        f(module[at] & 0xffffU, std::span(module).subspan(at + 1, length - 1));
        at += length;
    }
}

std::string text_of(std::span<const std::uint32_t> operands)
{
    std::string text;
    for (const std::uint32_t word : operands)
        for (unsigned shift = 0; shift < 32; shift += 8) {
            const auto letter = static_cast<char>(word >> shift & 255U);
            if (letter == '\0')
                return text;
            text += letter;
        }
    return text;
}

// Values by the ids that the module gives to options of these names.
std::unordered_map<std::uint32_t, words> values_of(words& module, const std::map<std::string, std::uint32_t>& options)
{
    std::unordered_map<std::uint32_t, std::uint32_t> spec_ids;
    std::unordered_map<std::uint32_t, std::uint32_t> by_object;
    for_each_instruction(module, [&](std::uint32_t op, std::span<const std::uint32_t> o) {
        if (op == op_name)
            if (const auto found = options.find(text_of(o.subspan(1))); found != options.end())
                by_object[o[0]] = found->second;
        if (op == op_decorate && o[1] == decoration_spec_id)
            spec_ids[o[0]] = o[2];
    });
    std::unordered_map<std::uint32_t, words> values;
    for (const auto& [object, value] : by_object)
        if (const auto found = spec_ids.find(object); found != spec_ids.end())
            values[found->second] = { value };
    return values;
}

words run(spvtools::Optimizer& optimizer, const words& module)
{
    words result;
    if (!optimizer.Run(module.data(), module.size(), &result))
        throw error("spirv-tools refuse a module");
    return result;
}

words specialised(words module, const std::map<std::string, std::uint32_t>& options)
{
    const auto values = values_of(module, options);
    for_each_instruction(module, [](std::uint32_t op, std::span<std::uint32_t> o) {
        if (op == op_loop_merge)
            o[2] = (o[2] & ~std::uint32_t{ loop_dont_unroll }) | loop_unroll;
    });
    spvtools::Optimizer first(SPV_ENV_UNIVERSAL_1_3);
    first.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values));
    first.RegisterPass(spvtools::CreateFreezeSpecConstantValuePass());
    first.RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass());
    first.RegisterPerformancePasses();
    spvtools::Optimizer second(SPV_ENV_UNIVERSAL_1_3);
    second.RegisterPass(spvtools::CreateLoopUnrollPass(true));
    second.RegisterPerformancePasses();
    return run(second, run(first, module));
}

pixel_cost count(words module, double trips)
{
    std::unordered_map<std::uint32_t, double> components; // of vector types
    std::vector<std::uint32_t> merges;                    // of the loops around an instruction
    double times = 1;
    bool in_function = false;
    std::unordered_map<std::uint32_t, std::uint32_t> type_of;
    pixel_cost cost;
    // A loop's header is the block that ends in OpLoopMerge, so what it holds before that belongs to the loop, too: counted by
    // holding back the block until its end is known.
    double block_fetches = 0;
    double block_operations = 0;
    const auto end_block = [&] {
        cost.fetches += times * block_fetches;
        cost.operations += times * block_operations;
        block_fetches = block_operations = 0;
    };
    for_each_instruction(module, [&](std::uint32_t op, std::span<std::uint32_t> o) {
        if (op == op_type_vector)
            components[o[0]] = o[2];
        in_function = in_function || op == op_function;
        if (!in_function)
            return;
        if (op == op_label) {
            end_block();
            while (!merges.empty() && merges.back() == o[0]) {
                merges.pop_back();
                times /= trips;
            }
        }
        else if (op == op_loop_merge) {
            merges.push_back(o[0]);
            times *= trips;
        }
        else if (fetches(op)) {
            block_fetches += 1;
        }
        else if (computes(op)) {
            const auto vector = components.find(o[0]);
            double width = vector == components.end() ? 1.0 : vector->second;
            if (op == op_dot) { // of the operand's width: products and sums
                const auto operand = components.find(type_of[o[2]]);
                width = operand == components.end() ? 1.0 : 2 * operand->second - 1;
            }
            block_operations += width;
        }
        // Result types of whatever may be an operand of a dot product.
        if (o.size() >= 2 && op != op_label)
            type_of[o[1]] = o[0];
    });
    end_block();
    return cost;
}

using options_of_pass = std::map<std::string, std::uint32_t>;

options_of_pass options_of(const ao::plan& p, const ao::pass& each)
{
    const pass_options& o = each.options;
    const auto number = [](int x) { return static_cast<std::uint32_t>(x); };
    return { { "ao_affine", o.affine },
             { "ao_tap_count", number(o.tap_count) },
             { "ao_normal_source", number(o.normal_source) },
             { "ao_rotate_normals", o.rotate_normals },
             { "ao_parallel", o.parallel },
             { "ao_limit_thickness", o.limit_thickness },
             { "ao_mark_background", o.mark_background },
             { "ao_filter_radius", number(o.filter_radius) },
             { "ao_slice_count", number(o.slice_count) },
             { "ao_coarse", o.coarse },
             { "depth_in_z", p.facts.depth == depth_source::position } };
}

options_of_pass options_of(const temporal_options& o)
{
    const auto number = [](int x) { return static_cast<std::uint32_t>(x); };
    return { { "ao_most_samples", number(o.most_samples) },
             { "ao_contribution", number(o.contribution) },
             { "ao_history_format", number(o.history_format) },
             { "ao_invalidation", number(o.invalidation) },
             { "ao_reproject", o.reproject },
             { "ao_use_motion", o.use_motion },
             { "ao_cubic", o.cubic },
             { "ao_normal_source", number(o.normal_source) },
             { "ao_rotate_normals", o.rotate_normals },
             { "ao_parallel", o.parallel },
             { "ao_limit_thickness", o.limit_thickness },
             { "ao_filter_radius", number(o.filter_radius) },
             { "ao_affine", o.affine },
             { "ao_slice_taps", number(o.slice_taps) } };
}

std::span<const std::uint32_t> shader_of(const ao::pass& each)
{
    using namespace vk::shaders;
    switch (each.type) {
    case pass_type::linearize:
        return linearize_comp;
    case pass_type::occlusion:
        return occlusion_comp;
    case pass_type::filter_rows:
        return filter_rows_comp;
    case pass_type::filter_columns:
        return filter_columns_comp;
    case pass_type::bitmask:
        return each.options.mark_background ? bitmask_comp_packed : bitmask_comp;
    case pass_type::denoise_rows:
        return denoise_rows_comp;
    case pass_type::denoise_columns:
        return denoise_columns_comp;
    }
    return {};
}

std::span<const std::uint32_t> shader_of(temporal_pass_type type)
{
    using namespace vk::shaders;
    switch (type) {
    case temporal_pass_type::linearize:
        return linearize_comp;
    case temporal_pass_type::accumulate:
        return temporal_accumulate_comp;
    case temporal_pass_type::filter_rows:
        return temporal_rows_comp;
    case temporal_pass_type::filter_columns:
        return temporal_columns_comp;
    case temporal_pass_type::resolve:
        return temporal_resolve_comp;
    }
    return {};
}

// Texels of a picture per pixel.
double share_of(const ao::plan& p, image_id id)
{
    const ao::extent size = extent_of(p, id);
    return static_cast<double>(size.width) * size.height / (static_cast<double>(p.facts.width) * p.facts.height);
}

double bytes_of(const ao::plan& p, image_id id)
{
    switch (id) {
    case image_id::depth:
        return bytes_per_pixel(p.facts.depth_format);
    case image_id::normal:
        return bytes_per_pixel(p.facts.normal_format);
    case image_id::visibility:
        return bytes_per_pixel(p.facts.output_format);
    case image_id::none:
    case image_id::rotation: // a tile
        return 0;
    default:
        for (const transient_image& each : p.transients)
            if (each.id == id)
                return bytes_per_pixel(each.format) * share_of(p, id);
        return 0;
    }
}

double bytes_of(const temporal_plan& p, const temporal_step& step)
{
    const ao::facts& f = p.facts.frame;
    const double depth = p.linearize ? 4 : bytes_per_pixel(f.depth_format);
    const double history = static_cast<double>(history_bytes(p)) / f.width / f.height;
    const double output = bytes_per_pixel(f.output_format);
    constexpr double row = 4;
    switch (step.type) {
    case temporal_pass_type::linearize:
        return bytes_per_pixel(f.depth_format) + 4;
    case temporal_pass_type::accumulate:
        return depth + (f.normals == normal_source::from_depth ? 0 : bytes_per_pixel(f.normal_format)) +
               (step.options.use_motion ? bytes_per_pixel(p.facts.motion_format) : 0) + 2 * history;
    case temporal_pass_type::filter_rows:
        return history + depth + row;
    case temporal_pass_type::filter_columns:
        return history + depth + row + output;
    case temporal_pass_type::resolve:
        return history + output;
    }
    return 0;
}

} // namespace

pixel_cost cost_of_module(std::span<const std::uint32_t> module, const std::map<std::string, std::uint32_t>& options,
                          double trips)
{
    return count(specialised(words(module.begin(), module.end()), options), trips);
}

std::optional<pixel_cost> cost_of(const ao::plan& p, const ao::pass& each)
{
    // The same pass is part of many plans.
    static std::map<std::pair<pass_type, options_of_pass>, pixel_cost> known;
    const auto options = options_of(p, each);
    const auto [at, fresh] = known.try_emplace({ each.type, options });
    if (fresh) {
        const int radius = each.options.filter_radius;
        const int window = each.options.coarse ? radius + 1 : 2 * radius + 1;
        at->second = cost_of_module(shader_of(each), options, radius > 0 ? window : std::max(each.options.tap_count, 1));
    }
    const double share = share_of(p, each.output);
    pixel_cost cost = at->second;
    cost.passes = 1;
    cost.fetches *= share;
    cost.operations *= share;
    cost.bytes = bytes_of(p, each.output);
    for (const image_id id : each.inputs)
        cost.bytes += bytes_of(p, id);
    return cost;
}

std::optional<pixel_cost> cost_of(const ao::temporal_plan& p, std::span<const std::size_t> steps, int samples)
{
    static std::map<std::tuple<temporal_pass_type, int, options_of_pass>, pixel_cost> known;
    pixel_cost all;
    for (const std::size_t i : steps) {
        const temporal_step& step = p.steps[i];
        const auto options = options_of(step.options);
        const auto [at, fresh] = known.try_emplace({ step.type, samples, options });
        if (fresh) {
            const bool filters = step.type == temporal_pass_type::filter_rows || step.type == temporal_pass_type::filter_columns;
            at->second = cost_of_module(shader_of(step.type), options, filters ? 2 * step.options.filter_radius + 1 : samples);
        }
        pixel_cost cost = at->second;
        cost.passes = 1;
        cost.bytes = bytes_of(p, step);
        all += cost;
    }
    return all;
}
#else
std::optional<pixel_cost> cost_of(const ao::plan&, const ao::pass&)
{
    return std::nullopt;
}

std::optional<pixel_cost> cost_of(const ao::temporal_plan&, std::span<const std::size_t>, int)
{
    return std::nullopt;
}
#endif

std::optional<pixel_cost> cost_of(const ao::plan& p)
{
    pixel_cost all;
    for (const ao::pass& each : p.passes) {
        const auto cost = cost_of(p, each);
        if (!cost)
            return std::nullopt;
        all += *cost;
    }
    return all;
}

} // namespace ao::tools
