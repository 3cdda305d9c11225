// Where the program is, for the timing model that watches it (qemu/timing/marked_timer.hpp): three empty functions.
#pragma once

extern "C" {
void glsum_mark_row();  ///< a row begins: caches and branch predictor are cold
void glsum_mark_on();   ///< what follows is timed
void glsum_mark_off();
}
