#include "descriptor_stream.h"

#include <dcmtk/dcmdata/dcerror.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

namespace vicon::ingest {
namespace {

constexpr std::size_t kBlockBytes = 1 << 16;

class DescriptorStreamFactory : public DcmInputStreamFactory {
public:
    DescriptorStreamFactory(int descriptor, offile_off_t from) : descriptor_(descriptor), from_(from) {}
    DcmInputStream* create() const override { return new DescriptorStream(descriptor_, from_); }
    DcmInputStreamFactory* clone() const override { return new DescriptorStreamFactory(*this); }
    DcmInputStreamFactoryType ident() const override { return DFT_DcmInputFileStreamFactory; }

private:
    int descriptor_;
    offile_off_t from_;
};

}  // namespace

DescriptorProducer::DescriptorProducer(int descriptor, offile_off_t from)
    : descriptor_(descriptor), size_(::lseek(descriptor, 0, SEEK_END)), at_(from)
{
}

bool DescriptorProducer::fill()
{
    block_.resize(kBlockBytes);
    const ssize_t count = ::pread(descriptor_, block_.data(), block_.size(), at_);
    block_from_ = at_;
    block_.resize(std::size_t(std::max<ssize_t>(count, 0)));
    if (block_.empty())
        status_ = EC_InvalidStream;
    return !block_.empty();
}

offile_off_t DescriptorProducer::read(void* to, offile_off_t count)
{
    offile_off_t done = 0;
    while (done < count && at_ < size_) {
        const offile_off_t in_block = at_ - block_from_;
        if ((in_block < 0 || in_block >= offile_off_t(block_.size())) && !fill())
            break;
        const offile_off_t from = at_ - block_from_;
        const offile_off_t some = std::min(count - done, offile_off_t(block_.size()) - from);
        std::memcpy(static_cast<char*>(to) + done, block_.data() + from, std::size_t(some));
        done += some;
        at_ += some;
    }
    return done;
}

offile_off_t DescriptorProducer::skip(offile_off_t count)
{
    const offile_off_t some = std::min(count, size_ - at_);
    at_ += some;
    return some;
}

void DescriptorProducer::putback(offile_off_t count)
{
    if (count > at_)
        status_ = EC_PutbackFailed;
    else
        at_ -= count;
}

DescriptorStream::DescriptorStream(int descriptor, offile_off_t from)
    : DcmInputStream(&producer_), producer_(descriptor, from), descriptor_(descriptor)
{
}

DcmInputStreamFactory* DescriptorStream::newFactory() const
{
    if (currentProducer() != &producer_)  // decompressed bytes have no place in the file
        return nullptr;
    return new DescriptorStreamFactory(descriptor_, tell());
}

}  // namespace vicon::ingest
