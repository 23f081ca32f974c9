#include "haru.h"

#include <array>
#include <cstdio>

#include "vicon/core/error.h"

namespace vicon::report {

Haru::Haru() : document_(HPDF_New(&keepFailure, this))
{
    if (!document_)
        throw Error(ErrorCode::no_memory, "a PDF cannot be started");
}

Haru::~Haru()
{
    HPDF_Free(document_);
}

void Haru::keepFailure(HPDF_STATUS code, HPDF_STATUS detail, void* haru)
{
    auto* self = static_cast<Haru*>(haru);
    if (self->code_ == HPDF_OK) {
        self->code_ = code;
        self->detail_ = detail;
    }
}

void Haru::check() const
{
    if (code_ == HPDF_OK)
        return;
    if (code_ == HPDF_FAILD_TO_ALLOC_MEM)
        throw Error(ErrorCode::no_memory, "there is not enough memory for the report");
    std::array<char, 64> what{};
    std::snprintf(what.data(), what.size(), "libharu failed with %04lX (%lu)", code_, detail_);
    throw Error(ErrorCode::internal, what.data());
}

bool Haru::succeeded()
{
    const bool fine = code_ == HPDF_OK;
    if (!fine && code_ != HPDF_FAILD_TO_ALLOC_MEM) {
        HPDF_ResetError(document_);
        code_ = HPDF_OK;
    }
    return fine;
}

}  // namespace vicon::report
