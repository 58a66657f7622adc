// The headers that most tests include, precompiled. No file needs this header to compile.
#pragma once

#include <gtest/gtest.h>

#include "common_headers.hpp"
