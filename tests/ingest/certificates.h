#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "vicon/support/support.h"

namespace vicon::test {

/// Certificates made by openssl in a folder, under a name each: NAME.pem and its NAME.key.
class Certificates {
public:
    explicit Certificates(std::filesystem::path folder) : folder_(std::move(folder)) {}

    void makeAuthority(const std::string& name) const
    {
        shell("openssl req -x509 -newkey rsa:2048 -nodes -keyout " + name + ".key -out " + name +
              ".pem -days 90 -subj /CN=" + name);
    }
    /// A certificate for this machine of an authority, and its key, under this name.
    void certify(const std::string& name, const std::string& authority, const std::string& days = "60") const
    {
        shell("openssl req -newkey rsa:2048 -nodes -keyout " + name + ".key -out " + name + ".csr -subj /CN=" + name +
              " && printf 'subjectAltName=DNS:localhost,IP:127.0.0.1' > names && openssl x509 -req -in " + name +
              ".csr -CA " + authority + ".pem -CAkey " + authority + ".key -CAcreateserial -extfile names -days " +
              days + " -out " + name + ".pem");
    }

    /// In the folder.
    void shell(const std::string& line) const
    {
        const auto done = support::runCommand("cd " + folder_.string() + " && (" + line + ") 2>&1");
        ASSERT_EQ(done.exit_code, 0) << line << "\n" << done.output;
    }

private:
    std::filesystem::path folder_;
};

}  // namespace vicon::test
