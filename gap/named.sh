#!/bin/sh
# named.sh [--withheld] [EFFECT...]: each effect of the virtual stand, diagnosed beside the stand's linear model. With --withheld its name is
# taken off the list first: what comes out is then to be `unknown`, or a near equivalent whose remaining gap says that it is not all.
# A table; no EFFECT: all of them, and without --withheld some pairs. 20 s at 50 Hz with white noise of 0.003 rad; a staircase to learn
# from, random bits to judge by.
# GLSUM: the program (build/host/cli/glsum).
set -eu
cd "$(dirname "$0")/.."
glsum=$(realpath "${GLSUM:-build/host/cli/glsum}")
withheld=
if [ "${1:-}" = --withheld ]; then
    withheld=yes
    shift
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

sizes='
none
gain_error gain_error.gain=0.9
time_scale_error time_scale_error.scale=1.15
dead_time_error dead_time_error.extra_s=0.06
input_saturation input_saturation.limit=0.08
input_dead_zone input_dead_zone.width=0.015
start_up_threshold start_up_threshold.threshold=0.04
rate_limit rate_limit.per_s=0.1
actuator_lag actuator_lag.tau_s=0.12
supply_sag supply_sag.per_unit_s=0.1
gain_drift gain_drift.per_s=-0.01
coulomb_friction coulomb_friction.force=0.006
quadratic_drag quadratic_drag.coefficient=0.02
gravity_nonlinearity gravity_nonlinearity.angle_per_unit=1
end_stop end_stop.limit=0.8
backlash backlash.gap=0.1
structural_resonance structural_resonance.share=0.1 structural_resonance.hz=4
direction_asymmetry direction_asymmetry.tau_up_s=0.02 direction_asymmetry.tau_down_s=0.2
load_disturbance load_disturbance.size=0.02 load_disturbance.from_s=7 load_disturbance.to_s=9
sensor_offset sensor_offset.offset=0.03
sensor_drift sensor_drift.per_s=0.003
sensor_lag sensor_lag.tau_s=0.1
sensor_saturation sensor_saturation.limit=0.7
missed_counts missed_counts.sizes=0.04 missed_counts.at_s=8
dropped_samples dropped_samples.rate=0.1
sampling_jitter sampling_jitter.half_width_s=0.015
input_curve input_curve.curvature=0.6 input_curve.reference=0.1
direction_dependent_friction direction_dependent_friction.force_up=0.01
output_curve output_curve.curvature=0.15
encoder_quantisation encoder_quantisation.step=0.05
supply_sag.resistance supply_sag.resistance=2
backlash+gain_error backlash.gap=0.05 gain_error.gain=0.93
input_saturation+gravity_nonlinearity input_saturation.limit=0.08 gravity_nonlinearity.angle_per_unit=1
'

stand() {
    "$glsum" stand --ideal --set noise.deviation=0.003 --set interval_s=0.02 --duty 0.1 --until-s 20 "$@" >/dev/null 2>&1
}
stand --experiment staircase --seed 1 --out "$folder/plain.csv" --model "$folder/m.json"

printf '%-37s %-75s %7s %7s %7s\n' effect verdict before after 'at best'
printf '%s\n' "$sizes" | while read -r effect settings; do
    [ -n "$effect" ] || continue
    case $withheld$effect in yesnone | yes*[.+]*) continue ;; esac
    if [ $# -gt 0 ]; then
        case " $* " in *" $effect "*) ;; *) continue ;; esac
    fi
    options=
    for setting in $settings; do
        options="$options --set $setting"
    done
    # shellcheck disable=SC2086
    stand $options --experiment staircase --seed 2 --out "$folder/t.csv"
    # shellcheck disable=SC2086
    stand $options --experiment prbs --low-duty 0.02 --bit-s 0.5 --seed 3 --out "$folder/v.csv"
    # shellcheck disable=SC2086
    "$glsum" diagnose drive --model "$folder/m.json" --log "$folder/t.csv" --validate "$folder/v.csv" ${withheld:+--without $effect} \
        >"$folder/said" 2>/dev/null
    verdict=$(sed -n 's/^verdict: //p' "$folder/said" | cut -c 1-75)
    gaps=$(sed -n 's/^gap, .*: \([0-9.]*\) before, \([0-9.]*\) after, \([0-9.]*\) at best$/\1 \2 \3/p' "$folder/said")
    # shellcheck disable=SC2086
    printf '%-37s %-75s %7s %7s %7s\n' "$effect" "$verdict" $gaps
done
