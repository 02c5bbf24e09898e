// Any backend's baker with what it lives on.
#pragma once

#include "host/bake_runner.hpp"

#include <string>
#include <string_view>
#include <utility>

namespace ao::host {

template <class Device, class Baker>
class bake_runner_of final : public bake_runner {
public:
    bake_runner_of(std::string_view backend, std::string name, Device device, Baker baker)
        : backend_(backend),
          name_(std::move(name)),
          device_(std::move(device)),
          baker_(std::move(baker))
    {
    }
    std::string_view backend() const override { return backend_; }
    std::string device() const override { return name_; }
    ao::result<bake_sums> run(const bake_job& job, const bake_request& request) override { return baker_.run(job, request); }

private:
    std::string_view backend_;
    std::string name_;
    Device device_; // outlives the baker
    Baker baker_;
};

} // namespace ao::host
