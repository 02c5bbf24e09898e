#include "ao/bake_program.hpp"

#include "ao/bake_results.hpp"
#include "ao/bake_work.hpp"
#include "ao/outcome.hpp"
#include "scene/files.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>

namespace ao::tools {
namespace {

std::vector<bake_part> read_parts(const std::vector<std::string>& files)
{
    std::vector<bake_part> parts;
    for (const std::string& file : files) {
        const std::string bytes = read_file(file);
        try {
            parts.push_back(part_from(bytes));
        } catch (const error& e) {
            throw error(file + ": " + e.what());
        }
    }
    check_together(parts, files);
    return parts;
}

void check_outputs(const bake_options& o)
{
    for (const std::string& file : o.out)
        check_writable(file);
    for (const std::filesystem::path& file : { std::filesystem::path(o.picture), o.json, o.part })
        if (!file.empty())
            check_writable(file);
}

void print(const std::string& text)
{
    std::fputs(text.c_str(), stdout);
    if (std::fflush(stdout) != 0)
        throw error("cannot write to the standard output");
}

// What is done is in the part's file until all is written.
void write_all(const bake_options& o, const bake_choice& c, const bake_work& work, const bake_run_facts& facts, double seconds)
{
    std::optional<bake_results> results;
    if (o.sharded) {
        write_file(o.out[0], bytes_of(facts.parts[0]));
    }
    else {
        results = finish_work(o, work, facts.parts);
        write_results(o, work, *results);
    }
    if (!o.json.empty())
        write_file(o.json, json_of(o, c, work, facts, results ? &*results : nullptr, seconds));
    print(summary_of(work, facts, results ? &*results : nullptr));
}

} // namespace

void bake(const bake_options& o)
{
    const auto start = std::chrono::steady_clock::now();
    const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
    // What can fail at once fails before the work.
    check_outputs(o);
    if (!o.merge.empty()) {
        bake_run_facts facts;
        facts.parts = read_parts(o.merge);
        const bake_choice choice = choice_from(facts.parts[0].choice);
        const std::string model = o.model.empty() ? facts.parts[0].model : o.model;
        const bake_work work = prepare_work(model, choice, ao::bake_route::automatic);
        if (key_of(work.job) != facts.parts[0].key)
            throw error(model + ": not the model of which " + o.merge[0] + " is a part");
        for (const bake_part& p : facts.parts)
            facts.seconds += p.seconds;
        facts.reason = "merged";
        write_all(o, choice, work, facts, seconds());
        return;
    }
    const bake_choice choice = with_rule(o.choice);
    const bake_work work = prepare_work(o.model, choice, o.route);
    const bake_run_facts facts = run_work(o, choice, work);
    try {
        write_all(o, choice, work, facts, seconds());
    } catch (const error& e) {
        bool kept = false;
        try {
            kept = keep(o, facts.parts[0]);
        } catch (const error&) {
            // The disk may be full of the results; why they failed is what matters.
        }
        throw error(e.what() + (kept ? "; " + o.part.string() + " keeps the bake for --resume" : std::string()));
    }
    std::error_code failure;
    if (!o.part.empty())
        std::filesystem::remove(o.part, failure);
}

} // namespace ao::tools
