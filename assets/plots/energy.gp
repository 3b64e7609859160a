# Energy over time at the usual time step of one case.
#   texts.txt   title, contestants
#   data.txt    contestant (from 1), time, relative change
load "style.gp"
set title texts[1] noenhanced
set xlabel "time [s]"
set ylabel "relative change of energy"
set logscale y
set format y "10^{%T}"
set yrange [1e-17 : 1e3]
shown(e) = abs(e) > 1e-16 ? abs(e) : 1e-16

do for [kind in "svg png"] {
  if (kind eq "svg") { eval svg(820, 480) } else { eval png(820, 480) }
  plot for [k = 2:lines] "data.txt" using (column(1) == k - 1 ? column(2) : NaN):(shown(column(3))) \
    with linespoints lc rgb colourOf(texts[k]) pt pointOf(texts[k]) ps 0.6 title texts[k] noenhanced
  unset output
}
