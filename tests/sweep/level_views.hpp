// Views of real game levels, and what every backend makes of them. They lie outside the project: AO_SCENES in the
// environment, or else the folder that the build names.
#pragma once

#include "host/runner.hpp"
#include "scene/gbuffer.hpp"

#include <filesystem>
#include <string>
#include <vector>

struct level_view {
    std::string name;
    ao::tools::camera camera;
    float radius = 1.0f; // scene units
};

struct level {
    std::filesystem::path model;
    std::vector<level_view> views;
};

// Those of cameras.json whose model is there. What is missing is said in a warning.
std::vector<level> levels();

// One view as all backends are fed it: linear depth, normals in halves.
struct level_inputs {
    ao::tools::gbuffer surfaces;
    ao::facts facts;
    ao::camera camera;
    ao::picture depth;
    ao::picture normal;
};
level_inputs inputs_of(const ao::tools::scene& s, const ao::tools::ray_tree& tree, const level_view& view, int width, int height);

inline constexpr ao::method all_methods[] = { ao::method::box, ao::method::hemisphere, ao::method::halton };
const char* name_of(ao::method method);

// Runs the same frame on each, checks that no pixel differs in any bit, and that there is something to differ.
// Returns the picture.
std::vector<float> agreed_picture(const std::vector<ao::host::runner*>& runners, const ao::settings& s, const level_inputs& in);
