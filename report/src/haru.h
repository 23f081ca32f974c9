#pragma once

#include <hpdf.h>

namespace vicon::report {

/// libharu's document. libharu calls back on every failure; exceptions must not pass through its C code, so the first
/// failure is kept.
class Haru {
public:
    /// Throws Error{no_memory}.
    Haru();
    ~Haru();
    Haru(const Haru&) = delete;
    Haru& operator=(const Haru&) = delete;

    HPDF_Doc document() { return document_; }
    /// Throws the failure, as Error{no_memory} or Error{internal}.
    void check() const;
    /// Whether there was none; forgets it.
    bool succeeded();

private:
    static void keepFailure(HPDF_STATUS code, HPDF_STATUS detail, void* haru);

    HPDF_STATUS code_ = HPDF_OK, detail_ = 0;
    HPDF_Doc document_;
};

}  // namespace vicon::report
