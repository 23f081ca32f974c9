#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace vicon::app {

/// What is wrong with a command line, and what to do. Empty where nothing is: help or the version was asked for.
std::string wrongWordsOf(const CLI::App& command, const CLI::ParseError& e);

}  // namespace vicon::app
