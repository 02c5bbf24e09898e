// A bake in parts: what is done of it, kept in a file, and put together again bit for bit.
#pragma once

#include "ao/bake.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ao::tools {

// Vertices times lines, of the bake.
struct bake_area {
    std::size_t first_vertex = 0;
    std::size_t last_vertex = 0; // not included
    std::size_t first_line = 0;
    std::size_t last_line = 0;

    [[nodiscard]] std::uint64_t size() const
    {
        return std::uint64_t{ last_vertex - first_vertex } * std::uint64_t{ last_line - first_line };
    }
    friend bool operator==(const bake_area&, const bake_area&) = default;
};
[[nodiscard]] bake_area area_of(const bake_sums& s);
[[nodiscard]] bake_area area_of(const ao::bake_job& job);
[[nodiscard]] bool overlap(const bake_area& a, const bake_area& b);

// Part i of n (1 <= i <= n), the same always: a range of pairs of lines where there are many, else of vertices. May be empty.
[[nodiscard]] bake_area shard_of(const ao::bake_job& job, std::size_t i, std::size_t n);

struct bake_part {
    std::string choice; // what was asked for, in the program's own words
    std::string model;  // path
    std::uint64_t key = 0;
    std::size_t vertices = 0; // of the whole bake
    std::size_t lines = 0;
    std::size_t shard = 1;
    std::size_t shards = 1;
    bake_area wanted;
    std::vector<bake_sums> done; // nowhere twice
    std::string device;          // of the latest
    double seconds = 0;          // of baking

    [[nodiscard]] std::uint64_t size_done() const;
    [[nodiscard]] bool complete() const { return size_done() == wanted.size(); }
    // What is wanted and not done, largest pieces first found.
    [[nodiscard]] std::vector<bake_area> missing() const;
    // Joined with what is there where it continues that.
    void add(bake_sums sums);
};

// The same for the same sums and only for these, but for chance (2^-64): of the mesh, the lines and the settings.
[[nodiscard]] std::uint64_t key_of(const ao::bake_job& job);

// Ends with a sum over all of it.
[[nodiscard]] std::string bytes_of(const bake_part& part);
// Throws `error` for what is no part, cut short or damaged; without the file's name.
[[nodiscard]] bake_part part_from(std::string_view bytes);

// All sums of the bake. Precondition: together the parts have every place once.
[[nodiscard]] bake_sums together(const std::vector<bake_part>& parts);

// Throws `error` that names the file at fault: parts of different bakes, of which one is missing, or is there twice, or is not
// finished. `files` are the parts' names.
void check_together(const std::vector<bake_part>& parts, const std::vector<std::string>& files);

} // namespace ao::tools
