#pragma once
// The headers that a user's source file includes.

#include <array>

#include "certificates/search/define_certificate_search.h"
#include "kds/certificate_table.h"
