#pragma once

#include "ao/bake_work.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace ao::tools {

// What came out, by vertex of the mesh that was baked, and by vertex of the file where that is another.
struct bake_results {
    ao::bake_result baked;
    std::vector<float> coefficients; // of the file's vertices: means over their copies along creases
    std::vector<float> errors;
    std::vector<glm::vec3> bent;
    std::vector<glm::vec3> light;  // linear RGB, of the baked mesh; where asked for
    std::vector<glm::vec3> colors; // linear, of the baked mesh
    std::uint64_t rays = 0;
};
[[nodiscard]] bake_results finish_work(const bake_options& o, const bake_work& work, const std::vector<bake_part>& parts);

// Towards each vertex of the mesh without occlusion, linear RGB. Throws `error`.
[[nodiscard]] std::vector<glm::vec3> light_at(const bake_light& light, const bake_work& work);

// All files that were asked for but the JSON. Throws `error`.
void write_results(const bake_options& o, const bake_work& work, const bake_results& r);

// The mesh in its colours, from above a corner, as the bytes of a PNG. Throws `error`.
[[nodiscard]] std::string picture_of(const bake_model& m, const std::vector<glm::vec3>& colors, picture_size size);

// `r` is null for a shard.
[[nodiscard]] std::string json_of(const bake_options& o, const bake_choice& c, const bake_work& work, const bake_run_facts& f,
                                  const bake_results* r, double total_seconds);
[[nodiscard]] std::string summary_of(const bake_work& work, const bake_run_facts& f, const bake_results* r);

} // namespace ao::tools
