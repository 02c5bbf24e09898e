#include "ao/bake_work.hpp"
#include "ao/outcome.hpp"
#include "ao/rule_text.hpp"

#include "ao/bake_crease.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace ao::tools {
namespace {

using clock = std::chrono::steady_clock;

double seconds_since(clock::time_point start)
{
    return std::chrono::duration<double>(clock::now() - start).count();
}

ao::sphere_rule rule_of(const bake_choice& c)
{
    const auto negative = c.negative_weights ? negative_weights::allowed : negative_weights::refused;
    auto rule = c.rule_text.empty() ? named_rule(c.rule, negative) : parse_rule(c.rule_text, negative);
    if (!rule)
        throw error("--rule" + (c.rule_text.empty() ? std::string() : " " + c.rule) + ": " +
                    one_line(std::string(rule.error().reason())));
    return std::move(*rule);
}

// Every vertex the mean normal of the faces at its place.
void smooth(bake_model& m, const bake_triangles& t)
{
    const ao::split_mesh all = split_by_crease(m.positions, t.indices, 180.0);
    m.normals.assign(m.positions.size(), glm::vec3(0.0f));
    for (std::size_t i = 0; i < all.source.size(); ++i)
        m.normals[all.source[i]] = all.normals[i];
}

void split(bake_work& w, bake_triangles& t, double degrees)
{
    ao::split_mesh all = split_by_crease(w.model.positions, t.indices, degrees);
    std::vector<bool> used(w.model.positions.size(), false);
    for (const std::uint32_t v : all.source)
        used[v] = true;
    // Vertices of no face stay, to be reported as what they are.
    for (std::uint32_t v = 0; v < used.size(); ++v)
        if (!used[v]) {
            all.positions.push_back(w.model.positions[v]);
            all.normals.emplace_back(0.0f);
            all.source.push_back(v);
        }
    w.split.name = w.model.name;
    w.split.positions = std::move(all.positions);
    w.split.normals = std::move(all.normals);
    w.split.object_names = w.model.object_names;
    for (std::size_t i = 0; i < t.objects.size(); ++i)
        w.split.add_polygon(std::span(all.indices).subspan(3 * i, 3), t.objects[i]);
    t.indices = std::move(all.indices);
    w.sources = std::move(all.source);
}

void lay_ground(ao::bake_settings& s, int axis, const bake_model& m)
{
    double lowest = HUGE_VAL;
    for (const std::uint32_t c : m.corners) {
        const double height = m.positions[c][axis / 2] * (axis % 2 == 0 ? 1.0 : -1.0);
        if (std::isfinite(height))
            lowest = std::min(lowest, height);
    }
    s.ground_height = std::isfinite(lowest) ? lowest : 0.0;
}

} // namespace

std::string read_file(const std::string& path)
{
    std::error_code failure;
    if (std::filesystem::is_directory(path, failure))
        throw error(path + ": a directory");
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw error(path + ": " + (errno != 0 ? std::generic_category().message(errno) : std::string("cannot be read")));
    std::string bytes{ std::istreambuf_iterator<char>(file), {} };
    if (file.bad())
        throw error(path + ": cannot be read");
    return bytes;
}

bake_choice with_rule(bake_choice choice)
{
    std::error_code failure;
    const std::string kind = choice.rule.substr(0, choice.rule.find(':'));
    const bool named =
        kind.size() < choice.rule.size() && (kind == "lebedev" || kind == "fibonacci" || kind == "fibonacci-pairs" ||
                                             kind == "marsaglia" || kind == "halton" || kind == "halton-cosine");
    if (!named) {
        if (!std::filesystem::exists(choice.rule, failure))
            throw error("--rule: '" + one_line(choice.rule) +
                        "' is neither a file nor one of lebedev:N|fibonacci:N|fibonacci-pairs:N|marsaglia:N[:SEED]|halton:N|"
                        "halton-cosine:N");
        choice.rule_text = read_file(choice.rule);
        if (choice.rule_text.empty())
            throw error("--rule " + choice.rule + ": the file is empty");
    }
    (void)rule_of(choice);
    return choice;
}

bake_work prepare_work(const std::string& model, const bake_choice& choice, ao::bake_route route)
{
    bake_work w;
    bake_wanted wanted = read_choice(choice);
    const ao::sphere_rule rule = rule_of(choice);
    w.directions = rule.size();
    auto start = clock::now();
    w.model = load_bake_model(model);
    stop_if_interrupted();
    w.read_seconds = seconds_since(start);

    start = clock::now();
    bake_triangles t = triangles_of(w.model);
    w.triangles = t.objects.size();
    ao::bake_settings& s = wanted.settings;
    s.route = route;
    if (wanted.ground_beneath)
        lay_ground(s, *wanted.ground_beneath, w.model);
    if (wanted.normals == bake_normals::smooth)
        smooth(w.model, t);
    if (wanted.normals == bake_normals::crease)
        split(w, t, wanted.crease);
    const bake_model& baked = w.baked();
    w.job = take(model, prepare_bake({ baked.positions, baked.normals, t.indices, t.objects }, rule, s));
    if (w.job.mesh.triangles.empty())
        throw error(model + ": none of its " + std::to_string(w.triangles) + " triangles has an area");
    w.build_seconds = seconds_since(start);
    stop_if_interrupted();
    return w;
}

} // namespace ao::tools
