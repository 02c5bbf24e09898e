#pragma once

#include "ao/bake_settings.hpp"

#include <glm/vec3.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ao::tools {

// What decides the sums of a bake, as it was typed; kept with its parts.
struct bake_choice {
    std::string rule = "lebedev:5810";
    bool negative_weights = false;
    std::string coefficient = "uniform", distance = "infinite", falloff = "none", sides = "both", occluders = "all";
    std::string normals = "own", ground;
    bool rotate_per_vertex = false, bent_normals = false;
    long long seed = 1;

    std::string rule_text;      // of the file, if the rule is one
    std::string bits = "exact"; // or of a route that has its own: embree
};
[[nodiscard]] std::string to_text(const bake_choice& c);
// Throws `error`.
[[nodiscard]] bake_choice choice_from(const std::string& text);

// The options' values as they were typed.
struct bake_arguments {
    std::string model, backend = "cpu", device, lanes = "auto", route = "auto";
    bake_choice choice;
    std::vector<std::string> merge, out;
    std::string picture, size = "1024x768", remap, json, shard, part, light, eye;
    int threads = 0;
    double keep_every = 30, shininess = 0;
    bool progress = false, resume = false, has_model = false, has_choice = false, has_work = false, has_size = false;
    bool has_shininess = false;
};

struct bake_remap {
    double low = 0, high = 1, gamma = 1;
    // pow(clamp((x - low) / (high - low), 0, 1), gamma).
    [[nodiscard]] float operator()(float x) const;
};

struct picture_size {
    int width = 0, height = 0;
};

enum class bake_normals { own, smooth, crease };

// What a bake_choice says, each value known to make sense by itself.
struct bake_wanted {
    ao::bake_settings settings;
    bake_normals normals = bake_normals::own;
    double crease = 0;                 // degrees
    std::optional<int> ground_beneath; // 0..5: x, -x, y, ... is up and the lowest vertex lies on the ground
};
// With the bits of the choice.
[[nodiscard]] ao::bake_route route_of(const bake_choice& c);
[[nodiscard]] bake_wanted read_choice(const bake_choice& c);

// Light that vertices are shown in.
struct bake_light {
    std::string file;               // a picture of the surroundings; empty: none, the coefficient alone is shown
    std::optional<double> exponent; // of Phong's lobe; none: diffuse
    std::optional<glm::dvec3> eye;  // of the lobe, model units; none: above each vertex
};

struct bake_options {
    std::string model;
    std::string backend, device;
    int lanes = 0, threads = 0;
    bake_choice choice;
    ao::bake_route route = ao::bake_route::automatic;
    std::vector<std::string> merge;
    std::vector<std::string> out;
    std::string picture;
    picture_size size;
    bake_remap remap;
    bake_light light;
    std::filesystem::path json;
    std::size_t shard = 1, shards = 1;
    bool sharded = false;
    std::filesystem::path part; // what is done goes here; empty: nowhere
    double keep_every = 30;     // seconds
    bool resume = false, progress = false;
};

// Adds the subcommand's options, `a` is what they are parsed into; and tells which of them were given.
void add_bake_options(CLI::App& command, bake_arguments& a);
void note_given(const CLI::App& command, bake_arguments& a);

// Throws `error` naming the option at fault.
[[nodiscard]] bake_options check_arguments(const bake_arguments& a);

} // namespace ao::tools
