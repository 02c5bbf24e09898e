#include "sweep/bake_rules_mesh.hpp"

#include "scene/bake_model.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

rule_mesh::rule_mesh(std::string name, const std::string& path, ao::cpu::baker& baker) : name_(std::move(name)), baker_(baker)
{
    load(path);
    find_reference();
}

void rule_mesh::load(const std::string& path)
{
    const ao::tools::bake_model model = ao::tools::load_bake_model(path);
    indices_ = ao::tools::triangles_of(model).indices;
    const auto job = ao::prepare_bake({ model.positions, model.normals, indices_, {} }, *ao::lebedev_rule(6), {});
    REQUIRE(job);
    std::vector<std::uint32_t> baked;
    for (std::uint32_t v = 0; v < job->vertices(); ++v) {
        if ((job->mesh.flags[v] & ao::bake_unbaked) == 0) {
            baked.push_back(v);
        }
    }
    REQUIRE(baked.size() >= looked_at);
    std::vector<std::uint32_t> order;
    std::vector<bool> first(model.positions.size(), false);
    for (std::size_t i = 0; i < looked_at; ++i) {
        order.push_back(baked[(2 * i + 1) * baked.size() / (2 * looked_at)]);
        first[order.back()] = true;
    }
    for (std::uint32_t v = 0; v < model.positions.size(); ++v) {
        if (!first[v]) {
            order.push_back(v);
        }
    }
    std::vector<std::uint32_t> place(order.size());
    for (const std::uint32_t v : order) {
        place[v] = static_cast<std::uint32_t>(positions_.size());
        positions_.push_back(model.positions[v]);
        if (!model.normals.empty()) {
            normals_.push_back(model.normals[v]);
        }
    }
    for (std::uint32_t& v : indices_) {
        v = place[v];
    }
}

ao::bake_sums rule_mesh::sums_of(const ao::bake_job& job)
{
    auto sums = baker_.run(job, { .last_vertex = looked_at });
    REQUIRE(sums);
    return std::move(*sums);
}

// The mean of several turned sets. One bake gives both coefficients: the sum of the open directions has, along the normal, the
// open cosines, whose sum where nothing occludes is a quarter.
void rule_mesh::find_reference()
{
    std::array<std::vector<std::vector<double>>, 2> sets;
    for (std::uint32_t k = 0; k < reference_sets; ++k) {
        const auto rule = ao::fibonacci_rule(reference_directions, ao::rotation_of_index(100 + k));
        const auto job = ao::prepare_bake(input(), *rule, { .bent_normals = true });
        REQUIRE(job);
        const ao::bake_sums sums = sums_of(*job);
        sets[0].emplace_back();
        sets[1].emplace_back();
        for (std::size_t v = 0; v < looked_at; ++v) {
            const ao::bake_sum& s = sums.sums[v];
            const glm::dvec3 open = glm::dvec3(s.x, s.y, s.z) / std::ldexp(1.0, 30);
            sets[0].back().push_back(static_cast<double>(s.open) / s.all);
            sets[1].back().push_back(4 * glm::dot(open, glm::dvec3(job->mesh.vertices[v].normal)));
        }
    }
    for (std::size_t c = 0; c < sets.size(); ++c) {
        double squares = 0;
        for (std::size_t v = 0; v < looked_at; ++v) {
            double mean = 0;
            for (const std::vector<double>& set : sets[c]) {
                mean += set[v] / reference_sets;
            }
            for (const std::vector<double>& set : sets[c]) {
                squares += (set[v] - mean) * (set[v] - mean);
            }
            reference_[c].push_back(mean);
        }
        reference_error_[c] = std::sqrt(squares / (reference_sets * (reference_sets - 1) * static_cast<double>(looked_at)));
    }
}

rule_point rule_mesh::measure(const std::vector<ao::sphere_rule>& rules, int directions, ao::bake_coefficient coefficient)
{
    const std::vector<double>& truth = reference_[static_cast<std::size_t>(coefficient)];
    rule_point point{ .directions = directions };
    for (const ao::sphere_rule& rule : rules) {
        const auto job = ao::prepare_bake(input(), rule, { .coefficient = coefficient });
        REQUIRE(job);
        ao::bake_sums sums = sums_of(*job);
        // The others have no directions, and finish_bake leaves them out.
        sums.last_vertex = job->vertices();
        sums.sums.resize(job->vertices());
        const ao::bake_result baked = ao::finish_bake(*job, sums);
        for (std::size_t v = 0; v < looked_at; ++v) {
            const double error = std::abs(static_cast<double>(baked.coefficients[v]) - truth[v]);
            point.error += error * error;
            point.worst = std::max(point.worst, error);
            // Where nothing occludes both are 0, but for what the reference rounds.
            point.within_two += error <= 2 * static_cast<double>(baked.errors[v]) + 1e-6 ? 1 : 0;
        }
        point.estimated += baked.report.typical_error * baked.report.typical_error * static_cast<double>(looked_at);
    }
    const double count = static_cast<double>(looked_at * rules.size());
    point.error = std::sqrt(point.error / count);
    point.estimated = std::sqrt(point.estimated / count);
    point.within_two /= count;
    return point;
}
