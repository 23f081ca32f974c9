#include "wrong_words.h"

#include <CLI/CLI.hpp>

#include "vicon/core/nearest_name.h"

namespace vicon::app {
namespace {

std::string noSuchSubcommand(const CLI::App& command, const std::string& typed)
{
    std::vector<std::string> names;
    for (const CLI::App* subcommand : command.get_subcommands(nullptr))
        names.push_back(subcommand->get_name());
    constexpr std::size_t kMostLetters = 2;
    const std::string nearest = nearestName(typed, names, kMostLetters);
    return "there is no subcommand '" + typed + "'; " + (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") +
           "'vicon --help' lists all";
}

}  // namespace

std::string wrongWordsOf(const CLI::App& command, const CLI::ParseError& e)
{
    const std::vector<std::string> left = command.remaining();
    if (command.get_subcommands().empty() && !left.empty() && !left.front().starts_with('-'))
        return noSuchSubcommand(command, left.front());
    return e.get_exit_code() == 0 ? "" : std::string(e.what()) + "; see 'vicon --help'";
}

}  // namespace vicon::app
