#include "ao/temporal_options.hpp"

#include "ao/option_words.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace ao::tools {

void add_temporal_options(CLI::App& command, temporal_arguments& a)
{
    CLI::Option* const temporal =
        command.add_flag("--temporal", a.wanted, "ambient occlusion that reuses earlier frames, over an animation");
    const auto add = [&](const char* name, auto& value, const char* text) {
        command.add_option(name, value, text)->needs(temporal);
    };
    add("--motion", a.motion, "static|orbit|pan|cut|file of camera and objects, for --temporal (docs/scenes.md)");
    add("--samples", a.samples, "K1,K2 of --temporal: per pixel and frame while little is known, and later; without it 32,8");
    add("--most-weight", a.most_weight, "of --temporal: samples that a history stands for at most");
    add("--contribution", a.contribution, "of --temporal: ritschel|fox-compton, or bitmask, which --preset stands for");
    add("--density", a.density, "of --temporal: hemisphere (ritschel), disc-area or disc-linear (fox-compton), slices (bitmask)");
    add("--history", a.history, "of --temporal: precise|packed|half-stalls");
    add("--invalidation", a.invalidation, "of --temporal: none|smooth|clamp, where a neighbourhood changed");
    add("--smoothness", a.smoothness, "of --temporal: how fast smooth invalidation forgets");
    // These are the other effect's, or read its result.
    for (const char* name : { "--method", "--taps", "--slices", "--resolution", "--bent-normal", "--shade" })
        temporal->excludes(command.get_option(name));
}

temporal_choice check_temporal(const temporal_arguments& a, const ao::settings& common)
{
    static constexpr std::array<std::pair<std::string_view, contribution_type>, 3> contributions{ {
        { "ritschel", contribution_type::ritschel },
        { "fox-compton", contribution_type::fox_compton },
        { "bitmask", contribution_type::bitmask },
    } };
    static constexpr std::array<std::pair<std::string_view, sample_density>, 4> densities{ {
        { "hemisphere", sample_density::hemisphere },
        { "disc-area", sample_density::disc_area },
        { "disc-linear", sample_density::disc_linear },
        { "slices", sample_density::slices },
    } };
    static constexpr std::array<std::pair<std::string_view, history_format>, 3> formats{ {
        { "precise", history_format::precise },
        { "packed", history_format::packed },
        { "half-stalls", history_format::half_stalls },
    } };
    static constexpr std::array<std::pair<std::string_view, invalidation_type>, 3> invalidations{ {
        { "none", invalidation_type::none },
        { "smooth", invalidation_type::smooth },
        { "clamp", invalidation_type::clamp },
    } };
    temporal_choice t{ a.motion, {} };
    ao::temporal_settings& s = t.settings;
    const bool slices = common.method == method::bitmask;
    if (slices)
        s = temporal_settings_of(common);
    if (!a.contribution.empty()) {
        s.contribution = choose("--contribution", a.contribution, contributions);
        if (slices != (s.contribution == contribution_type::bitmask))
            throw error(slices ? "--preset: of --contribution bitmask" : "--contribution bitmask: takes a --preset");
    }
    if (s.contribution == contribution_type::fox_compton)
        s.density = sample_density::disc_area;
    if (!a.density.empty())
        s.density = choose("--density", a.density, densities);
    s.format = choose("--history", a.history, formats);
    s.invalidation = choose("--invalidation", a.invalidation, invalidations);
    s.radius = common.radius;
    s.bias = common.bias;
    s.thickness = common.thickness;
    s.filter = common.filter;
    s.seed = common.seed;
    s.smoothness = static_cast<float>(a.smoothness);
    s.most_weight = a.most_weight.value_or(s.most_weight);
    // So that a small --most-weight needs no option beside it.
    s.clamped_weight = std::min(s.clamped_weight, std::max(s.most_weight, 0));
    if (!a.samples.empty()) {
        const std::vector<std::string> counts = split(a.samples, ',');
        if (counts.size() != 2)
            throw error("--samples: '" + one_line(a.samples) + "' is not K1,K2");
        s.first_samples = number<int>("--samples", counts[0]);
        s.later_samples = number<int>("--samples", counts[1]);
    }
    if (const auto wrong = validate(s))
        throw error("--temporal: " + std::string(wrong->reason()));
    return t;
}

} // namespace ao::tools
