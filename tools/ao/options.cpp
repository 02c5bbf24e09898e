#include "ao/options.hpp"

#include "ao/option_words.hpp"

#include <CLI/CLI.hpp>

#include <cmath>
#include <limits>
#include <tuple>

namespace ao::tools {
namespace {

float finite(const char* option, double value, double limit)
{
    if (!(std::abs(value) <= limit))
        throw error(std::string(option) + ": must be a finite number, at most " + std::to_string(static_cast<long long>(limit)));
    return static_cast<float>(value);
}

extent parse_size(const std::string& text)
{
    const std::vector<std::string> parts = split(text, 'x');
    if (parts.size() != 2)
        throw error("--size: '" + one_line(text) + "' is not WIDTHxHEIGHT");
    const extent size{ number<int>("--size", parts[0]), number<int>("--size", parts[1]) };
    constexpr int side = 16384;
    constexpr long long pixels = 1LL << 25;
    if (size.width < 1 || size.height < 1 || size.width > side || size.height > side ||
        static_cast<long long>(size.width) * size.height > pixels)
        throw error("--size: 1 to 16384 pixels a side, at most 33554432 in all");
    return size;
}

glm::vec3 parse_eye(const std::string& text)
{
    const std::vector<std::string> parts = split(text, ',');
    if (parts.size() != 3)
        throw error("--eye: '" + one_line(text) + "' is not X,Y,Z");
    glm::vec3 eye{ 0.0f };
    for (int i = 0; i < 3; ++i)
        eye[i] = finite("--eye", number<double>("--eye", parts[static_cast<std::size_t>(i)]), 1e15);
    return eye;
}

projection_choice parse_projection(const std::string& text)
{
    // Pictures are kept with row 0 on top, which NDC y = +1 shows unless y points down.
    projection_choice p;
    for (const std::string& word : split(text, ',')) {
        if (word == "perspective")
            p.options.parallel = false;
        else if (word == "parallel" || word == "orthographic")
            p.options.parallel = true;
        else if (word == "zero-to-one")
            p.options.range = ao::depth_range::zero_to_one;
        else if (word == "minus-one-to-one")
            p.options.range = ao::depth_range::minus_one_to_one;
        else if (word == "reversed")
            p.options.reversed = true;
        else if (word == "infinite")
            p.infinite = true;
        else if (word == "y-down")
            p.options.y_down = true;
        else
            throw error("--projection: '" + one_line(word) +
                        "' is none of perspective|parallel|zero-to-one|minus-one-to-one|reversed|infinite|y-down");
    }
    p.options.rows = p.options.y_down ? first_row::at_ndc_minus_one : first_row::at_ndc_plus_one;
    if (p.infinite && p.options.parallel)
        throw error("--projection: a parallel projection has no infinite far plane");
    return p;
}

void parse_inputs(const render_arguments& a, facts& f)
{
    using depth = std::pair<depth_source, pixel_format>;
    static constexpr std::array<std::pair<std::string_view, depth>, 5> depths{ {
        { "linear", { depth_source::linear, pixel_format::r32f } },
        { "d32f", { depth_source::hardware, pixel_format::d32f } },
        { "d24", { depth_source::hardware, pixel_format::d24 } },
        { "position16", { depth_source::position, pixel_format::rgba16f } },
        { "position32", { depth_source::position, pixel_format::rgba32f } },
    } };
    using normals = std::pair<normal_source, pixel_format>;
    static constexpr std::array<std::pair<std::string_view, normals>, 4> normal_formats{ {
        { "rgba16f", { normal_source::vector, pixel_format::rgba16f } },
        { "rgb10a2", { normal_source::unorm10, pixel_format::rgb10a2 } },
        { "octahedral", { normal_source::octahedral, pixel_format::rg16 } },
        { "none", { normal_source::from_depth, pixel_format::rgba16f } },
    } };
    const bool rays = a.gbuffer == "rays";
    std::tie(f.depth, f.depth_format) = choose("--depth", !a.depth.empty() ? a.depth : rays ? "linear" : "d32f", depths);
    if (f.depth == depth_source::linear && !rays)
        throw error("--depth linear: no rasterizer stores it; it takes --gbuffer rays");
    std::tie(f.normals, f.normal_format) = choose("--normals", a.normals, normal_formats);
    if (a.shade && f.normals == normal_source::from_depth)
        throw error("--normals none: --shade needs normals");
}

ao::settings parse_settings(const render_arguments& a)
{
    static constexpr std::array<std::pair<std::string_view, ao::method>, 4> methods{ {
        { "box", method::box },
        { "hemisphere", method::hemisphere },
        { "halton", method::halton },
        { "bitmask", method::bitmask },
    } };
    static constexpr std::array<std::pair<std::string_view, ao::preset>, 4> presets{ {
        { "low", preset::low },
        { "medium", preset::medium },
        { "high", preset::high },
        { "ultra", preset::ultra },
    } };
    ao::settings s;
    if (!a.method.empty())
        s.method = choose("--method", a.method, methods);
    else if (!a.temporal.wanted) // whose own estimate is another
        s.method = method::bitmask;
    if (!a.preset.empty() || s.method == method::bitmask) {
        const ao::preset chosen = a.preset.empty() ? preset::high : choose("--preset", a.preset, presets);
        if (!a.method.empty() && s.method != method::bitmask)
            throw error("--preset: of --method bitmask");
        s = settings_of(chosen);
        if (a.temporal.wanted) { // every pixel is estimated in every frame
            s.resolution = resolution::full;
            s.filter = ao::settings{}.filter;
        }
    }
    s.taps = a.taps.value_or(s.taps);
    s.slices = a.slices.value_or(s.taps % s.slices == 0 ? s.slices : 1);
    if (a.slices && s.method != method::bitmask)
        throw error("--slices: of --method bitmask");
    static constexpr std::array<std::pair<std::string_view, ao::resolution>, 2> resolutions{ {
        { "full", resolution::full },
        { "half", resolution::half },
    } };
    if (!a.resolution.empty())
        s.resolution = choose("--resolution", a.resolution, resolutions);
    else if (a.filter == 1) // nothing would find the pixels between the estimates
        s.resolution = resolution::full;
    s.bent_normal = a.bent_normal;
    s.radius = static_cast<float>(a.radius);
    s.bias = static_cast<float>(a.bias.value_or(static_cast<double>(s.bias)));
    s.filter = a.filter.value_or(s.filter);
    if (a.thickness == "infinite")
        s.thickness = std::numeric_limits<float>::infinity();
    else if (!a.thickness.empty())
        s.thickness = number<float>("--thickness", a.thickness);
    if (a.seed < 0 || a.seed > 0xffffffffLL)
        throw error("--seed: 0 to 4294967295");
    s.seed = static_cast<std::uint32_t>(a.seed);
    if (const auto wrong = validate(s))
        throw error(std::string(wrong->reason()));
    return s;
}

} // namespace

void add_render_options(CLI::App& command, render_arguments& a)
{
    command.add_option("SCENE", a.scene, "a model that Assimp reads, or 'courtyard'")->required();
    command.add_option("--backend", a.backend, "cpu|gl|vk|all, or several with commas");
    command.add_option("--device", a.device, "part of the GL or Vulkan device's name; without it llvmpipe and lavapipe");
    command.add_option("--route", a.route, "of gl: compute|fragment|all");
    command.add_option("--lanes", a.lanes, "of cpu: auto|scalar|4|8|16");
    command.add_option("--method", a.method, "box|hemisphere|halton|bitmask; bitmask without it");
    command.add_option("--preset", a.preset, "of bitmask: low|medium|high|ultra, which sets what is not given; high without it");
    command.add_option("--taps", a.taps, "per pixel, 1 to 1024; of bitmask per estimate, of all slices together");
    command.add_option("--slices", a.slices, "of bitmask, 1 to 16: taps are of all slices together");
    command.add_option("--resolution", a.resolution, "of bitmask: full|half, one estimate a pixel or per 2x2 pixels");
    command.add_flag("--bent-normal", a.bent_normal,
                     "of bitmask: the mean open direction as well; --shade takes ambient light there");
    command.add_option("--radius", a.radius, "scene units");
    command.add_option("--bias", a.bias, "scene units");
    command.add_option("--thickness", a.thickness, "in radii, or 'infinite'");
    command.add_option("--filter", a.filter, "pixels a side, odd, 1 to 31");
    command.add_option("--gbuffer", a.gbuffer,
                       "depth and normals from: raster (each backend draws its own)|rays (the same for all)");
    command.add_option("--depth", a.depth,
                       "input: d32f|d24|position16|position32, and of rays linear; without it d32f, or linear of rays");
    command.add_option("--normals", a.normals, "input: rgba16f|rgb10a2|octahedral|none");
    command.add_flag("--shade", a.shade, "shade the scene, ambient light scaled by visibility");
    command.add_flag("--multi-bounce", a.multi_bounce, "tint visibility by the diffuse color, for --shade");
    command.add_option("--blend", a.blend, "file of blended materials, for --shade (docs/scenes.md)");
    command.add_option("--lights", a.lights, "default|none|file of lights, for --shade (docs/scenes.md)");
    command.add_option("--size", a.size, "WIDTHxHEIGHT");
    command.add_option("--eye", a.eye, "X,Y,Z in scene units; without it the whole scene is in view");
    command.add_option("--yaw", a.yaw, "degrees; 0 looks along -z, 90 along +x");
    command.add_option("--pitch", a.pitch, "degrees, -90 to 90");
    command.add_option("--fov", a.fov, "vertical, degrees");
    command.add_option("--projection", a.projection,
                       "words with commas: perspective|parallel, zero-to-one|minus-one-to-one, reversed, infinite, y-down");
    command.add_option("--seed", a.seed, "of the random kernels and rotations");
    command.add_option("--reference", a.reference, "rays per pixel of the ray-traced truth, even; 0: none");
    command.add_option("--frames", a.frames,
                       "timed after warm-up, 5 without it; times are their medians; of --temporal: shown, 32");
    command.add_option("--out", a.out, "directory for pictures and report.html");
    command.add_option("--json", a.json, "file for the numbers");
    command.add_flag("--progress", a.progress, "share done and time left on stderr");
    add_temporal_options(command, a.temporal);
}

render_options check_arguments(const render_arguments& a)
{
    render_options o;
    o.scene = a.scene;
    o.cpu = o.gl = o.vk = false;
    for (const std::string& word : split(a.backend, ',')) {
        static constexpr std::array<std::pair<std::string_view, int>, 4> backends{
            { { "cpu", 1 }, { "gl", 2 }, { "vk", 4 }, { "all", 7 } }
        };
        const int chosen = choose("--backend", word, backends);
        o.cpu = o.cpu || (chosen & 1) != 0;
        o.gl = o.gl || (chosen & 2) != 0;
        o.vk = o.vk || (chosen & 4) != 0;
    }
    static constexpr std::array<std::pair<std::string_view, int>, 3> routes{
        { { "compute", 1 }, { "fragment", 2 }, { "all", 3 } }
    };
    const int route = choose("--route", a.route, routes);
    o.gl_compute = (route & 1) != 0;
    o.gl_fragment = (route & 2) != 0;
    static constexpr std::array<std::pair<std::string_view, int>, 5> widths{
        { { "auto", 0 }, { "scalar", 1 }, { "4", 4 }, { "8", 8 }, { "16", 16 } }
    };
    o.lanes = choose("--lanes", a.lanes, widths);
    o.device = a.device;
    o.settings = parse_settings(a);
    o.size = parse_size(a.size);
    o.projection = parse_projection(a.projection);
    static constexpr std::array<std::pair<std::string_view, bool>, 2> origins{ { { "raster", false }, { "rays", true } } };
    o.rays = choose("--gbuffer", a.gbuffer, origins);
    parse_inputs(a, o.inputs);
    if (o.settings.bent_normal)
        o.inputs.output_format = pixel_format::rgba16f;
    o.shade = a.shade;
    if (!a.shade && a.multi_bounce)
        throw error("--multi-bounce needs --shade");
    o.multi_bounce = a.multi_bounce;
    if (!a.shade && (!a.blend.empty() || !a.lights.empty()))
        throw error(std::string(a.blend.empty() ? "--lights" : "--blend") + " needs --shade");
    o.blend = a.blend;
    if (!a.lights.empty())
        o.lights = a.lights;
    o.inputs.width = o.size.width;
    o.inputs.height = o.size.height;
    o.inputs.parallel = o.projection.options.parallel;

    if (!a.eye.empty())
        o.eye = parse_eye(a.eye);
    else if (a.has_yaw || a.has_pitch)
        throw error("--yaw and --pitch need --eye");
    o.yaw = finite("--yaw", a.yaw, 1e6);
    if (!(a.pitch >= -90.0 && a.pitch <= 90.0))
        throw error("--pitch: -90 to 90 degrees");
    o.pitch = static_cast<float>(a.pitch);
    if (a.has_fov) {
        if (!(a.fov >= 0.1 && a.fov <= 179.0))
            throw error("--fov: 0.1 to 179 degrees");
        o.fov = static_cast<float>(a.fov);
    }
    if (a.reference < 0 || a.reference > 65536 || a.reference % 2 != 0)
        throw error("--reference: even, 0 to 65536");
    o.reference = static_cast<unsigned>(a.reference);
    if (a.frames < 1 || a.frames > 100000)
        throw error("--frames: 1 to 100000");
    o.frames = a.temporal.wanted && !a.has_frames ? 32 : a.frames;
    if (a.temporal.wanted)
        o.temporal = check_temporal(a.temporal, o.settings);
    if (o.temporal && a.route == "fragment")
        throw error("--route fragment: --temporal runs as compute");
    o.out = a.out;
    o.json = a.json;
    o.progress = a.progress;
    return o;
}

} // namespace ao::tools
