# Error of place over time of every toss, and their mean.
#   texts.txt   title, label of the errors
#   data.txt    toss (from 1; 0: mean of all), time, error
load "style.gp"
set title texts[1] noenhanced
set xlabel "time [s]"
set ylabel texts[2] noenhanced
set yrange [0 : *]
stats "data.txt" using 1 nooutput
tosses = int(STATS_max)

do for [kind in "svg png"] {
  if (kind eq "svg") { eval svg(820, 480) } else { eval png(820, 480) }
  plot for [k = 1:tosses] "data.txt" using (column(1) == k ? column(2) : NaN):3 with lines lc rgb "#999999" lw 0.7 notitle, \
    "data.txt" using (column(1) == 0 ? column(2) : NaN):3 with lines lc rgb "#c8553d" lw 3 title "mean"
  unset output
}
