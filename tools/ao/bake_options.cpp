#include "ao/bake_options.hpp"

#include "ao/lobe_rule.hpp"
#include "ao/option_words.hpp"
#include "scene/bake_files.hpp"
#include "scene/error.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>

namespace ao::tools {
namespace {

// The choices that parts carry.
constexpr const char* choice_names[] = { "--rule",  "--negative-weights", "--coefficient", "--distance", "--falloff",
                                         "--sides", "--occluders",        "--normals",     "--ground",   "--rotate-per-vertex",
                                         "--seed",  "--bent-normals" };
// What finds the sums, which merging does not.
constexpr const char* work_names[] = {
    "--backend", "--device", "--lanes", "--threads", "--route", "--shard", "--resume", "--part"
};

ao::bake_route parse_route(const std::string& word)
{
    static constexpr std::array<std::pair<std::string_view, ao::bake_route>, 8> routes{ {
        { "auto", bake_route::automatic },
        { "brute", bake_route::brute },
        { "tiled", bake_route::tiled },
        { "packed", bake_route::packed },
        { "hierarchy", bake_route::hierarchy },
        { "raster", bake_route::raster },
        { "embree", bake_route::embree },
        { "cube", bake_route::cube },
    } };
    return choose("--route", word, routes);
}

bake_remap parse_remap(const std::string& text)
{
    bake_remap r;
    if (text.empty())
        return r;
    const std::vector<std::string> words = split(text, ',');
    if (words.size() != 3)
        throw error("--remap: '" + one_line(text) + "' is not LOW,HIGH,GAMMA");
    double* const to[] = { &r.low, &r.high, &r.gamma };
    for (std::size_t i = 0; i < 3; ++i) {
        *to[i] = number<double>("--remap", words[i]);
        if (!(std::abs(*to[i]) <= 1e6))
            throw error("--remap: numbers of at most 1000000");
    }
    if (!(r.low < r.high) || !(r.gamma > 0.0))
        throw error("--remap: LOW must be below HIGH, and GAMMA above 0");
    return r;
}

picture_size parse_size(const std::string& text)
{
    const std::vector<std::string> parts = split(text, 'x');
    if (parts.size() != 2)
        throw error("--size: '" + one_line(text) + "' is not WIDTHxHEIGHT");
    const picture_size s{ number<int>("--size", parts[0]), number<int>("--size", parts[1]) };
    if (s.width < 1 || s.height < 1 || s.width > 4096 || s.height > 4096)
        throw error("--size: 1 to 4096 pixels a side");
    return s;
}

void parse_shard(const std::string& text, bake_options& o)
{
    if (text.empty())
        return;
    const std::vector<std::string> words = split(text, '/');
    if (words.size() != 2)
        throw error("--shard: '" + one_line(text) + "' is not I/N");
    o.shard = number<std::size_t>("--shard", words[0]);
    o.shards = number<std::size_t>("--shard", words[1]);
    o.sharded = true;
    if (o.shards < 1 || o.shards > 1'000'000 || o.shard < 1 || o.shard > o.shards)
        throw error("--shard: I is 1 to N, and N at most 1000000");
}

bake_light parse_light(const bake_arguments& a)
{
    bake_light l;
    l.file = a.light;
    if (a.light.empty() && (a.has_shininess || !a.eye.empty()))
        throw error(std::string(a.has_shininess ? "--shininess" : "--eye") + " needs --light");
    if (a.has_shininess) {
        if (!(a.shininess >= 0.0 && a.shininess <= max_lobe_exponent))
            throw error("--shininess: 0 to 8192");
        l.exponent = a.shininess;
    }
    if (a.eye.empty())
        return l;
    if (!l.exponent)
        throw error("--eye needs --shininess: diffuse light is the same from everywhere");
    const std::vector<std::string> words = split(a.eye, ',');
    if (words.size() != 3)
        throw error("--eye: '" + one_line(a.eye) + "' is not X,Y,Z");
    l.eye.emplace(0.0);
    for (int i = 0; i < 3; ++i) {
        (*l.eye)[i] = number<double>("--eye", words[static_cast<std::size_t>(i)]);
        if (!std::isfinite((*l.eye)[i]))
            throw error("--eye: numbers must be finite");
    }
    return l;
}

void check_outputs(const bake_arguments& a, bake_options& o)
{
    if (o.sharded) {
        if (a.out.size() != 1)
            throw error("--shard needs one --out, the file of the part");
        if (!a.picture.empty() || !a.remap.empty() || !a.light.empty())
            throw error("--shard: there is nothing to show before the parts are merged");
    }
    else {
        for (const std::string& file : a.out)
            (void)bake_format_of(file);
    }
    if (!a.picture.empty() && std::filesystem::path(a.picture).extension() != ".png")
        throw error("--picture: " + a.picture + ": the name must end in .png");
    if (a.has_size && a.picture.empty())
        throw error("--size needs --picture");
    o.out = a.out;
    o.picture = a.picture;
    o.json = a.json;
    std::vector<std::string> all = a.out;
    all.insert(all.end(), { a.picture, a.json, a.part });
    std::sort(all.begin(), all.end());
    const auto same = std::adjacent_find(std::upper_bound(all.begin(), all.end(), std::string()), all.end());
    if (same != all.end() && same->rfind("/dev/", 0) != 0)
        throw error(*same + ": is to be written twice");
    if (!a.part.empty())
        o.part = a.part;
    else if (!a.out.empty() && a.merge.empty() && a.out[0].rfind("/dev/", 0) != 0)
        o.part = a.out[0] + ".part";
    if (o.resume && o.part.empty())
        throw error("--resume needs --out or --part");
}

} // namespace

float bake_remap::operator()(float x) const
{
    return static_cast<float>(std::pow(std::clamp((static_cast<double>(x) - low) / (high - low), 0.0, 1.0), gamma));
}

void add_bake_options(CLI::App& command, bake_arguments& a)
{
    command.add_option("MODEL", a.model, "PLY, OBJ, or what else Assimp reads; with --merge that of the parts without it");
    command.add_option("--backend", a.backend, "cpu|gl|vk");
    command.add_option("--device", a.device, "part of the GL or Vulkan device's name; without it llvmpipe and lavapipe");
    command.add_option("--lanes", a.lanes, "of cpu: auto|scalar|4|8|16");
    command.add_option("--threads", a.threads, "of cpu; 0: all");
    command.add_option("--route", a.route, "auto|brute|tiled|packed|hierarchy|raster|embree|cube; not every backend has all");
    command.add_option("--rule", a.choice.rule,
                       "lebedev:N (N even: points; odd: order)|fibonacci:N|fibonacci-pairs:N|marsaglia:N[:SEED]|halton:N|"
                       "halton-cosine:N|file of lines x y z weight");
    command.add_flag("--negative-weights", a.choice.negative_weights, "allow rules that have some");
    command.add_option("--coefficient", a.choice.coefficient, "uniform|cosine");
    command.add_option("--distance", a.choice.distance, "of occluders, in diagonals of the model; without it infinite");
    command.add_option("--falloff", a.choice.falloff, "of occluders with their distance: none|linear|smooth");
    command.add_option("--sides", a.choice.sides, "of faces that occlude: both|front");
    command.add_option("--occluders", a.choice.occluders, "objects: all|own|others");
    command.add_option("--normals", a.choice.normals, "own (computed where there are none)|smooth|crease:DEGREES");
    command.add_option("--ground", a.choice.ground,
                       "a plane that occludes: AXIS (beneath the model)|AXIS,HEIGHT|X,Y,Z,HEIGHT; AXIS is x, -x, y ...");
    command.add_flag("--rotate-per-vertex", a.choice.rotate_per_vertex, "noise in place of banding");
    command.add_option("--seed", a.choice.seed, "of these rotations");
    command.add_flag("--bent-normals", a.choice.bent_normals, "the mean open direction of each vertex as well");
    command.add_option("--out", a.out, "file, as often as wanted: .ply .glb .obj (colours) .npy .csv (values)")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option("--picture", a.picture, "PNG of the model in its colours");
    command.add_option("--size", a.size, "WIDTHxHEIGHT of the picture");
    command.add_option("--remap", a.remap, "LOW,HIGH,GAMMA of the colours; values alone stay as they are");
    command.add_option("--light", a.light,
                       "picture of the surroundings (HDR, EXR ...): colours are its light times the coefficient");
    command.add_option("--shininess", a.shininess, "exponent of Phong's lobe, for --light; without it diffuse");
    command.add_option("--eye", a.eye, "X,Y,Z from where --shininess is seen; without it from above each vertex");
    command.add_option("--json", a.json, "file for the numbers");
    command.add_flag("--progress", a.progress, "share done and time left on stderr");
    command.add_option("--shard", a.shard, "I/N: only part I of N, to the file of --out");
    command.add_option("--merge", a.merge, "files of all parts, put together")->expected(1, 1'000'000);
    command.add_option("--part", a.part, "file for what is done when the bake is ended early; without it --out with .part");
    command.add_option("--keep-every", a.keep_every, "seconds after which what is done is kept");
    command.add_flag("--resume", a.resume, "go on with what was kept, if there is such");
}

void note_given(const CLI::App& command, bake_arguments& a)
{
    const auto given = [&](const char* name) { return command.count(name) > 0; };
    a.has_model = given("MODEL");
    a.has_choice = std::any_of(std::begin(choice_names), std::end(choice_names), given);
    a.has_work = std::any_of(std::begin(work_names), std::end(work_names), given);
    a.has_size = given("--size");
    a.has_shininess = given("--shininess");
}

bake_options check_arguments(const bake_arguments& a)
{
    bake_options o;
    if (a.merge.empty() ? !a.has_model : false)
        throw error("MODEL is required");
    if (!a.merge.empty() && a.has_choice)
        throw error("--merge: the parts say how they were baked; only outputs can be chosen");
    if (!a.merge.empty() && a.has_work)
        throw error("--merge: nothing is baked, so no backend, route, shard or part can be chosen");
    static constexpr std::array<std::pair<std::string_view, int>, 3> backends{ { { "cpu", 0 }, { "gl", 1 }, { "vk", 2 } } };
    (void)choose("--backend", a.backend, backends);
    static constexpr std::array<std::pair<std::string_view, int>, 5> widths{
        { { "auto", 0 }, { "scalar", 1 }, { "4", 4 }, { "8", 8 }, { "16", 16 } }
    };
    o.lanes = choose("--lanes", a.lanes, widths);
    if (a.threads < 0 || a.threads > 4096)
        throw error("--threads: 0 to 4096");
    o.threads = a.threads;
    o.model = a.model;
    o.backend = a.backend;
    o.device = a.device;
    o.route = parse_route(a.route);
    o.choice = a.choice;
    if (o.route == bake_route::embree || o.route == bake_route::cube)
        o.choice.bits = a.route;
    (void)read_choice(a.choice);
    o.merge = a.merge;
    o.resume = a.resume;
    o.progress = a.progress;
    o.remap = parse_remap(a.remap);
    o.light = parse_light(a);
    o.size = parse_size(a.size);
    parse_shard(a.shard, o);
    if (!(a.keep_every >= 0.0 && a.keep_every <= 1e6))
        throw error("--keep-every: 0 to 1000000 seconds");
    o.keep_every = a.keep_every;
    check_outputs(a, o);
    return o;
}

} // namespace ao::tools
