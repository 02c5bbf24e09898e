#include "ao/chart_options.hpp"

#include "ao/chart_configurations.hpp"
#include "ao/option_words.hpp"
#include "ao/settings.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace ao::tools {
namespace {

extent parse_size(const std::string& text)
{
    const std::vector<std::string> parts = split(text, 'x');
    if (parts.size() != 2)
        throw error("--size: '" + one_line(text) + "' is not WIDTHxHEIGHT");
    const extent size{ number<int>("--size", parts[0]), number<int>("--size", parts[1]) };
    if (size.width < 8 || size.height < 8 || size.width > 4096 || size.height > 4096)
        throw error("--size: 8 to 4096 pixels a side");
    return size;
}

std::vector<std::string> parse_methods(const std::string& text)
{
    std::vector<std::string> wanted = split(text, ',');
    const std::vector<std::string> known = chart_methods();
    std::string all;
    for (const std::string& name : known)
        all += (all.empty() ? "" : "|") + name;
    for (const std::string& name : wanted)
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw error("--methods: '" + one_line(name) + "' is none of " + all);
    return wanted;
}

} // namespace

void add_chart_options(CLI::App& command, chart_arguments& a)
{
    command.add_option("--scenes", a.scenes, "JSON file of models and cameras to chart beside the bundled scene (docs/chart.md)");
    command.add_flag("--no-bundled", a.no_bundled, "without the bundled scene");
    command.add_option("--methods", a.methods, "several with commas; without it all");
    command.add_option("--backends", a.backends, "cpu|gl|vk|all, or several with commas");
    command.add_option("--device", a.device, "part of the GL or Vulkan device's name; without it llvmpipe and lavapipe");
    command.add_option("--taps", a.taps, "several with commas; without it 4,8,16,32,64");
    command.add_option("--size", a.size, "WIDTHxHEIGHT");
    command.add_option("--reference", a.rays, "rays per pixel of the ray-traced truth, even");
    command.add_option("--rounds", a.rounds, "timed frames of each configuration, backend and view");
    command.add_option("--frames", a.frames, "of the animations that temporal methods are charted over");
    command.add_option("--parts", a.parts, "what to chart, several with commas: frames|motion|vertices");
    command.add_option("--out", a.out, "directory for chart.json");
    command.add_option("--json", a.json, "file for the numbers, in place of DIR/chart.json");
    command.add_flag("--progress", a.progress, "what is being done and the share of it, on stderr");
}

chart_options check_arguments(const chart_arguments& a)
{
    chart_options o;
    o.scenes = a.scenes;
    o.bundled = !a.no_bundled;
    if (a.no_bundled && a.scenes.empty())
        throw error("--no-bundled: there is nothing left without --scenes");
    if (!a.methods.empty())
        o.methods = parse_methods(a.methods);
    if (a.backends != "all") {
        o.backends.clear();
        for (const std::string& word : split(a.backends, ',')) {
            if (word != "cpu" && word != "gl" && word != "vk")
                throw error("--backends: '" + one_line(word) + "' is none of cpu|gl|vk|all");
            o.backends.push_back(word);
        }
    }
    if (!a.taps.empty()) {
        o.taps.clear();
        for (const std::string& word : split(a.taps, ',')) {
            o.taps.push_back(number<int>("--taps", word));
            if (o.taps.back() < 1 || o.taps.back() > max_taps)
                throw error("--taps: 1 to " + std::to_string(max_taps));
        }
    }
    o.size = parse_size(a.size);
    if (a.rays < 2 || a.rays > 65536 || a.rays % 2 != 0)
        throw error("--reference: even, 2 to 65536");
    o.rays = static_cast<unsigned>(a.rays);
    if (a.rounds < 1 || a.rounds > 1000)
        throw error("--rounds: 1 to 1000");
    o.rounds = a.rounds;
    if (a.frames < 4 || a.frames > 10000)
        throw error("--frames: 4 to 10000");
    o.frames = 0;
    o.vertices = false;
    bool single = false;
    for (const std::string& word : split(a.parts, ',')) {
        if (word == "frames")
            single = true;
        else if (word == "motion")
            o.frames = a.frames;
        else if (word == "vertices")
            o.vertices = true;
        else
            throw error("--parts: '" + one_line(word) + "' is none of frames|motion|vertices");
    }
    if (!single)
        o.rounds = 0;
    o.device = a.device;
    o.out = a.out;
    o.json = a.json.empty() && !a.out.empty() ? o.out / "chart.json" : std::filesystem::path(a.json);
    o.progress = a.progress;
    return o;
}

} // namespace ao::tools
