0 BEGIN PGM groove-on-a-line MM
1 ; program groove-on-a-line, HEIDENHAIN TNC
2 ; part groove-on-a-line, aluminium, 4 mm thick
3 ; stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000
4 ; origin: axis of the part, Z0 on top of the stock
5 ; origin preset 1, Z0 on top of the stock, units mm and mm/min
6 ; T24 D 6 mm: mill-6, end mill
7 CYCL DEF 247 DATUM SETTING ~
  Q339=+1 ;DATUM NUMBER
8 CYCL DEF 32.0 TOLERANCE
9 CYCL DEF 32.1 T0.002
10 L Z+0 R0 FMAX M91
11 ; operation: groove: slot
12 TOOL CALL 24 Z S11671
13 M3
14 L X-30 Y-5 R0 FMAX
15 L Z+5 R0 FMAX
16 M8
17 L Z+1 R0 FMAX
18 L Z+0 F1750
19 L X-10.899 Z-1 F880
20 L X-30 Z-2
21 L X+0 F1750
22 CC X-0.001 Y+5.001
23 C X+9.32 Y+1.376 DR+
24 CC X-0.001 Y+5.001
25 C X+0 Y-5 DR-
26 L X-30
27 L Z+5 R0 FMAX
28 M9
29 M5
30 L Z+0 R0 FMAX M91
31 M30
32 END PGM groove-on-a-line MM
