# Maximum excursion, 4/10 thick ice (1.2 m). Redraw: gnuplot -d excursion_400.gp
set terminal svg size 1000,420 dynamic noenhanced font 'sans-serif,14' background '#ffffff'
set output 'excursion_400.svg'
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
set label 99 '400_www_uu, 30 seeds, coupled  gem 0.1.0 (4af374c18374), coupled  gem 0.1.0 (4e93e10c64dd)' at screen 0.995, graph 1.0 right offset 0,0.9 font ',9' textcolor rgb '#9aa0a8' noenhanced front
set key outside bottom left horizontal
set xlabel 'drift velocity [m/s]' offset 0,0.4
set ylabel 'maximum excursion [m]'
set xrange [0:1.1]
set yrange [0:10.1]
plot 'excursion_400_400.csv' using 1:2 with lines linestyle 1 notitle, '' using ($1-0.006):2:3:4 with yerrorbars linestyle 1 lw 0.5 ps 0 notitle, '' using ($1-0.006):2:5:6 with yerrorbars linestyle 1 lw 2 pt 7 ps 0.6 title 'W = 400 m', 'excursion_400_300.csv' using 1:2 with lines linestyle 2 notitle, '' using ($1):2:3:4 with yerrorbars linestyle 2 lw 0.5 ps 0 notitle, '' using ($1):2:5:6 with yerrorbars linestyle 2 lw 2 pt 7 ps 0.6 title 'W = 300 m', 'excursion_400_200.csv' using 1:2 with lines linestyle 3 notitle, '' using ($1+0.006):2:3:4 with yerrorbars linestyle 3 lw 0.5 ps 0 notitle, '' using ($1+0.006):2:5:6 with yerrorbars linestyle 3 lw 2 pt 7 ps 0.6 title 'W = 200 m'
