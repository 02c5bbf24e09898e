#include "ao/chart_configurations.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace ao::tools {
namespace {

constexpr int middle_taps = 16; // of what varies anything else
constexpr int usual_filter = 5;

struct family {
    const char* name;
    ao::settings base; // but for taps
    std::vector<std::pair<const char*, preset>> presets;
};

ao::settings of(ao::method m)
{
    ao::settings s;
    s.method = m;
    return s;
}

// A new method is one line here.
std::vector<family> families()
{
    return {
        { "box", of(method::box), {} },
        { "hemisphere", of(method::hemisphere), {} },
        { "halton", of(method::halton), {} },
        { "bitmask",
          settings_of(preset::high),
          { { "low", preset::low }, { "medium", preset::medium }, { "high", preset::high }, { "ultra", preset::ultra } } },
    };
}

// Beside bitmask, which serves single frames too.
constexpr std::array<const char*, 2> temporal_methods{ "ritschel", "fox-compton" };

bool wanted(const chart_options& o, const std::string& method)
{
    return o.methods.empty() || std::find(o.methods.begin(), o.methods.end(), method) != o.methods.end();
}

chart_configuration make(const family& f, int taps, int filter, const std::string& varies)
{
    chart_configuration c;
    c.method = f.name;
    c.varies = varies;
    c.settings = f.base;
    c.settings.taps = taps;
    c.settings.filter = filter;
    if (filter == 1)
        c.settings.resolution = resolution::full;
    c.name = c.method + " " + std::to_string(taps) + (taps == 1 ? " tap" : " taps");
    if (filter != f.base.filter)
        c.name += filter == 1 ? ", no filter" : ", filter " + std::to_string(filter);
    return c;
}

chart_configuration named(chart_configuration c, const std::string& what)
{
    c.name += ", " + what;
    return c;
}

// Everything else that a user can choose, each by itself beside the middle of the taps.
void add_choices(std::vector<chart_configuration>& all, const family& f)
{
    const auto base = [&](const char* varies) { return make(f, middle_taps, f.base.filter, varies); };
    for (const int filter : { 1, 3, 9 })
        all.push_back(make(f, middle_taps, filter, "filter"));
    using depth = std::pair<const char*, std::pair<depth_source, pixel_format>>;
    for (const auto& [name, d] : { depth{ "d32f", { depth_source::hardware, pixel_format::d32f } },
                                   depth{ "d24", { depth_source::hardware, pixel_format::d24 } },
                                   depth{ "positions rgba16f", { depth_source::position, pixel_format::rgba16f } },
                                   depth{ "positions rgba32f", { depth_source::position, pixel_format::rgba32f } } }) {
        chart_configuration c = named(base("depth"), name);
        c.facts.depth = d.first;
        c.facts.depth_format = d.second;
        all.push_back(c);
    }
    using normals = std::pair<const char*, std::pair<normal_source, pixel_format>>;
    for (const auto& [name, n] : { normals{ "normals rgba32f", { normal_source::vector, pixel_format::rgba32f } },
                                   normals{ "normals rgb10a2", { normal_source::unorm10, pixel_format::rgb10a2 } },
                                   normals{ "normals octahedral", { normal_source::octahedral, pixel_format::rg16 } },
                                   normals{ "normals from depth", { normal_source::from_depth, pixel_format::rgba16f } } }) {
        chart_configuration c = named(base("normals"), name);
        c.facts.normals = n.first;
        c.facts.normal_format = n.second;
        all.push_back(c);
    }
    chart_configuration r8 = named(base("output"), "output r8");
    r8.facts.output_format = pixel_format::r8;
    all.push_back(r8);
}

} // namespace

std::vector<std::string> chart_methods()
{
    std::vector<std::string> names;
    for (const family& f : families())
        names.emplace_back(f.name);
    names.insert(names.end(), temporal_methods.begin(), temporal_methods.end());
    return names;
}

std::vector<chart_configuration> single_configurations(const chart_options& o)
{
    std::vector<chart_configuration> all;
    for (const family& f : families()) {
        if (!wanted(o, f.name))
            continue;
        for (const int taps : o.taps)
            if (f.base.method != method::bitmask || taps % f.base.slices == 0)
                all.push_back(make(f, taps, f.base.filter, "taps"));
        for (const auto& [name, chosen] : f.presets) {
            chart_configuration c = make(f, settings_of(chosen).taps, f.base.filter, "presets");
            c.settings = settings_of(chosen);
            c.name = c.method + " " + name + ", " + std::to_string(c.settings.taps) + " taps";
            all.push_back(c);
            if (c.settings.resolution == resolution::half) {
                chart_configuration full = named(c, "full resolution");
                full.varies = "resolution";
                full.settings.resolution = resolution::full;
                full.settings.filter = usual_filter;
                all.push_back(full);
            }
        }
        if (f.base.method == method::box) {
            // As printed in paper 1.
            chart_configuration printed = named(make(f, 32, f.base.filter, "thickness"), "infinite thickness");
            printed.settings.thickness = std::numeric_limits<float>::infinity();
            all.push_back(printed);
        }
        if (f.base.method == method::hemisphere)
            add_choices(all, f);
        for (int taps = 4; taps <= 256; taps *= 2) {
            chart_configuration c = make(f, taps, 1, "convergence");
            c.timed = false;
            const auto same = [&](const chart_configuration& other) { return other.name == c.name; };
            if (std::none_of(all.begin(), all.end(), same))
                all.push_back(c);
        }
    }
    return all;
}

std::vector<temporal_configuration> temporal_configurations(const chart_options& o)
{
    std::vector<temporal_configuration> all;
    const auto add = [&](const char* method, const std::string& name, ao::temporal_settings s) {
        if (wanted(o, method))
            all.push_back({ name, method, s });
    };
    for (const int samples : { 4, 8, 16 }) {
        ao::temporal_settings s;
        s.later_samples = samples;
        add("ritschel", "ritschel " + std::to_string(samples) + " samples", s);
    }
    ao::temporal_settings packed;
    packed.format = history_format::packed;
    add("ritschel", "ritschel 8 samples, packed history", packed);
    ao::temporal_settings bilinear;
    bilinear.cubic = false;
    add("ritschel", "ritschel 8 samples, bilinear", bilinear);
    ao::temporal_settings patches;
    patches.contribution = contribution_type::fox_compton;
    patches.density = sample_density::disc_area;
    add("fox-compton", "fox-compton 8 samples", patches);
    for (const auto& [name, chosen] : { std::pair{ "low", preset::low }, std::pair{ "medium", preset::medium } })
        add("bitmask", std::string("bitmask ") + name, temporal_settings_of(settings_of(chosen)));
    return all;
}

ao::settings limit_of(ao::settings s)
{
    s.taps = max_taps;
    // Steps of a quarter of a pixel and less serve nothing: many slices.
    s.slices = s.method == method::bitmask ? max_slices : 1;
    s.filter = 1;
    s.resolution = resolution::full;
    s.seed += 1000;
    return s;
}

} // namespace ao::tools
