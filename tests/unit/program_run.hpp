#pragma once

#include "tools_support.hpp"

#include <catch2/catch.hpp>

#include <csignal>
#include <fcntl.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

// Runs the program in `dir`, its streams in the files out and err there; stops it after `interrupt_after` milliseconds
// if that is not 0.
inline int run(const scratch_directory& dir, const std::vector<std::string>& arguments, unsigned interrupt_after = 0)
{
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const auto redirect = [&](const char* name, int to) {
            ::dup2(::open((dir.path / name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), to);
        };
        redirect("out", 1);
        redirect("err", 2);
        std::vector<const char*> argv{ AO_PROGRAM };
        for (const std::string& a : arguments)
            argv.push_back(a.c_str());
        argv.push_back(nullptr);
        ::execv(AO_PROGRAM, const_cast<char**>(argv.data()));
        _exit(127);
    }
    if (interrupt_after > 0) {
        ::usleep(interrupt_after * 1000);
        ::kill(child, SIGINT);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// Fails as it should: status 1, nothing on stdout, and one line on stderr in which the reason occurs.
inline void check_failure(const scratch_directory& dir, const std::vector<std::string>& arguments, const std::string& reason)
{
    std::string request;
    for (const std::string& a : arguments)
        request += a + ' ';
    INFO(request);
    CHECK(run(dir, arguments) == 1);
    const std::string message = read_all(dir.path / "err");
    INFO(message);
    CHECK(message.rfind("ao: ", 0) == 0);
    CHECK(message.find('\n') == message.size() - 1);
    CHECK(message.find(reason) != std::string::npos);
    CHECK(read_all(dir.path / "out").empty());
}
