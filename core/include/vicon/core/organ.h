#pragma once

#include <string>
#include <utility>

namespace vicon {

/// Which hollow organ a scan shows: the name of a preset of config/organs. No enumeration, because a preset adds one.
class Organ {
public:
    /// The colon.
    Organ() = default;
    explicit Organ(std::string name) : name_(std::move(name)) {}

    const std::string& name() const { return name_; }
    bool isColon() const { return *this == Organ(); }
    friend bool operator==(const Organ&, const Organ&) = default;

private:
    std::string name_ = "colon";
};

}  // namespace vicon
