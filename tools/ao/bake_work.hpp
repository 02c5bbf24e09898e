#pragma once

#include "ao/bake.hpp"
#include "ao/bake_options.hpp"
#include "scene/bake_model.hpp"
#include "scene/bake_part.hpp"

#include <string>
#include <vector>

namespace ao::tools {

// A model and what is baked of it.
struct bake_work {
    bake_model model;
    bake_model split;                   // along creases; empty where `model` itself is baked
    std::vector<std::uint32_t> sources; // vertex of `model` by vertex of `split`
    std::size_t triangles = 0;          // of the file
    std::size_t directions = 0;         // of the rule
    ao::bake_job job;
    double read_seconds = 0;
    double build_seconds = 0;

    [[nodiscard]] const bake_model& baked() const { return sources.empty() ? model : split; }
};

// Reads the model and prepares it. Throws `error`.
[[nodiscard]] bake_work prepare_work(const std::string& model, const bake_choice& choice, ao::bake_route route);

// With the text of the file that --rule names, if it names one. Throws `error`.
[[nodiscard]] bake_choice with_rule(bake_choice choice);

struct bake_run_facts {
    std::string backend, device, route, reason;
    double seconds = 0;           // of baking, those of earlier starts as well
    double kept = 0;              // share that was there from them
    std::vector<bake_part> parts; // that together are the bake, or the one shard
};

// Bakes this process's share, from what is kept on; keeps what is done when interrupted, or when the backend fails, and now and
// then. Throws `error`.
[[nodiscard]] bake_run_facts run_work(const bake_options& o, const bake_choice& choice, const bake_work& work);

// Writes the part to its file, if it has one and there is anything to keep; true if it did. Throws `error`.
bool keep(const bake_options& o, const bake_part& part);

[[nodiscard]] const char* name_of(ao::bake_route route);
[[nodiscard]] std::string read_file(const std::string& path);

} // namespace ao::tools
