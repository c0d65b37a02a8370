#pragma once

#include <CLI/CLI.hpp>
#include <functional>

/// \file Commands.h
/// The subcommands of vantage-benchmarks.

namespace vantage::benchmarks
{

/// What the command line asked for; runs after it was read.
using Command = std::function<void()>;

/// Each adds a subcommand with its options, which sets `chosen` when it is given.
void AddReferenceCommand(CLI::App& app, Command& chosen);
void AddSceneBuildCommand(CLI::App& app, Command& chosen);
void AddSpeedCommand(CLI::App& app, Command& chosen);
void AddStudyCommand(CLI::App& app, Command& chosen);
void AddWalkCommand(CLI::App& app, Command& chosen);

} // namespace vantage::benchmarks
