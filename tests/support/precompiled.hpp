// What most tests include, parsed once. No file depends on it.
#pragma once

#include <gtest/gtest.h>

#include "core/precompiled.hpp"
