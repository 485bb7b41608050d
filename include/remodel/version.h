#pragma once

// The library's version, by https://semver.org: until 1.0 a new minor version may change interfaces and files.

#define REMODEL_VERSION_MAJOR 0
#define REMODEL_VERSION_MINOR 3
#define REMODEL_VERSION_PATCH 0
#define REMODEL_VERSION "0.3.0"
