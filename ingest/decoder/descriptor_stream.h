#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcistrma.h>

#include <vector>

namespace vicon::ingest {

/// Bytes of an open file, from a place on, as DCMTK's reader takes them.
class DescriptorProducer : public DcmProducer {
public:
    DescriptorProducer(int descriptor, offile_off_t from);
    OFBool good() const override { return status_.good(); }
    OFCondition status() const override { return status_; }
    OFBool eos() override { return at_ >= size_; }
    offile_off_t avail() override { return size_ - at_; }
    offile_off_t read(void* to, offile_off_t count) override;
    offile_off_t skip(offile_off_t count) override;
    void putback(offile_off_t count) override;

private:
    bool fill();

    int descriptor_;
    offile_off_t size_, at_;
    offile_off_t block_from_ = 0;
    std::vector<char> block_;
    OFCondition status_ = EC_Normal;
};

/// An open file as DCMTK's input stream: large values stay in the file, as they do where it is read by name.
class DescriptorStream : public DcmInputStream {
public:
    DescriptorStream(int descriptor, offile_off_t from);
    DcmInputStreamFactory* newFactory() const override;

private:
    DescriptorProducer producer_;
    int descriptor_;
};

}  // namespace vicon::ingest
