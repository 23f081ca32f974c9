#pragma once

namespace vicon::viewer {

/// How long a case is read, without pauses: scan by scan, and all of them together.
class ReadingClock {
public:
    /// Time passed. @param reading whether the reader was at work; @param slices_first in slices, before the flight
    void pass(double seconds, bool reading, bool slices_first);
    void beginScan() { scan_s_ = slices_first_s_ = 0; }

    double scan_s() const { return scan_s_; }
    double slicesFirst_s() const { return slices_first_s_; }  ///< of the scan's
    double case_s() const { return case_s_; }

private:
    double scan_s_ = 0, slices_first_s_ = 0, case_s_ = 0;
};

inline void ReadingClock::pass(double seconds, bool reading, bool slices_first)
{
    if (!reading)
        return;
    scan_s_ += seconds;
    case_s_ += seconds;
    slices_first_s_ += slices_first ? seconds : 0;
}

}  // namespace vicon::viewer
