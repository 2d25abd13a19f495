# Net x force of the ice on the platform. Redraw: gnuplot -d ice_force.gp
set terminal svg size 1000,780 dynamic noenhanced font 'sans-serif,14' background '#ffffff'
set output 'ice_force.svg'
set encoding utf8
set datafile separator ','
set datafile columnheaders
set key noautotitle
set border 3 lc rgb '#8a8f98' lw 1
set tics nomirror out scale 0.5 font ',12' textcolor rgb '#3c4149'
set xtics offset 0,0.3
set grid xtics ytics back lc rgb '#e6e8eb' lw 1 dt solid
set key outside top left horizontal Left reverse width 1 samplen 1.6 spacing 1.15 textcolor rgb '#3c4149'
set lmargin 11
set rmargin 3
set tmargin 2
set style line 1 lc rgb '#31688e' lw 1.2
set style line 2 lc rgb '#c2571a' lw 1.4
set style line 3 lc rgb '#35a37a' lw 1.2
set style line 4 lc rgb '#8a8f98' lw 1.0
set style fill solid 1.0 noborder
set palette defined (0 '#440154', 1 '#482878', 2 '#3e4989', 3 '#31688e', 4 '#26828e', 5 '#1f9e89', 6 '#35b779', 7 '#6ece58', 8 '#b5de2b', 9 '#fde725')
set label 99 '004_400_25: coupled, dt 0.2 s, seed 1  gem 0.1.0 (4e93e10c64dd)' at screen 0.995, graph 1.0 right offset 0,0.9 font ',9' textcolor rgb '#9aa0a8' noenhanced front
set multiplot layout 3,1
set xzeroaxis lc rgb '#8a8f98' lw 0.8 dt solid
set xrange [4475.700:4508.700]
set xlabel
set ylabel 'crushing peak, x [MN]'
set yrange [*:*]
plot 0 with lines lc rgb '#8a8f98' lw 0.8 notitle, 'ice_force_peaks.csv' using 1:2 with impulses lc rgb '#d9b39c' lw 1.6 notitle, '' using 1:2 with points pt 7 ps 0.35 lc rgb '#c2571a' title 'each impact'
unset label 99
set xlabel 'time [s]' offset 0,0.4
set ylabel 'ice force, x [kN]'
plot 'ice_force_window.csv' using 1:2 with fsteps linestyle 1 title 'over each 0.2 s', 'ice_force_window_mean.csv' using 1:2 with lines lc rgb '#440154' lw 1.8 title 'over 1 s'
set xrange [0:2.000000]
set xlabel 'time [h]' offset 0,0.4
set object 1 rectangle from first 1.243250, graph 0 to first 1.252417, graph 1 behind fillcolor rgb '#f3d9c8' fillstyle solid noborder
plot 'ice_force.csv' using 1:2 with lines linestyle 1 lw 0.7
unset multiplot
