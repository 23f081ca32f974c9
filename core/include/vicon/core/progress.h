#pragma once

#include <string_view>

namespace vicon {

/// How long work tells how far it is, and learns that nobody wants it any more. Every method may be called from several
/// threads at once: parallel loops report from all of theirs.
class Progress {
public:
    virtual ~Progress() = default;
    /// @param fraction of the current work, 0 to 1
    virtual void report(double fraction, std::string_view what) = 0;
    virtual bool cancelled() const { return false; }
    /// Throws Error{cancelled} once the work was cancelled. Cheap enough for every slice.
    void check() const;
};

/// Tells nobody, never cancelled.
class NoProgress : public Progress {
public:
    void report(double, std::string_view) override {}
};

}  // namespace vicon
