#include "services/image/canvas.h"
