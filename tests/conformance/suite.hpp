// The conformance suite as a Catch2 check.
#pragma once

#include "ao/conformance/suite.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <string_view>
#include <vector>

// The failed cases of a run, one line each; skipped ones too, so that none goes unnoticed.
template <ao::conformance::subject S>
std::vector<std::string> faults_of(S& s, const ao::conformance::suite_options& options = {})
{
    std::vector<std::string> faults;
    ao::conformance::run_suite(
        s,
        [&](const ao::conformance::case_result& r) {
            if (r.verdict != ao::conformance::outcome::passed) {
                faults.push_back(ao::conformance::describe(r));
            }
        },
        options);
    return faults;
}

// Passes every case, and there are as many as there ought to be.
template <ao::conformance::subject S>
void check_suite(S& s, const ao::conformance::suite_options& options = {})
{
    const std::size_t wanted =
        (options.functions ? ao::conformance::functions.size() : 0) + (options.passes ? ao::conformance::all_pairs().size() : 0);
    const ao::conformance::suite_summary summary = ao::conformance::run_suite(
        s,
        [&](const ao::conformance::case_result& r) {
            INFO(s.name() << ": " << ao::conformance::describe(r));
            CHECK(r.verdict == ao::conformance::outcome::passed);
        },
        options);
    CHECK(static_cast<std::size_t>(summary.passed) == wanted);
}
