0 BEGIN PGM second-side-underside MM
1 ; program second-side-underside, HEIDENHAIN TNC
2 ; part second-side-underside, aluminium, 6 mm thick
3 ; stock 40.00 x 30.00 x 6 mm, from X-20.000 Y-15.000
4 ; origin: axis of the part, Z0 on top of the stock
5 ; the underside: the plate is turned over about X
6 ; origin preset 2, Z0 on top of the stock, units mm and mm/min
7 ; T24 D 6 mm: mill-6, end mill
8 CYCL DEF 247 DATUM SETTING ~
  Q339=+2 ;DATUM NUMBER
9 CYCL DEF 32.0 TOLERANCE
10 CYCL DEF 32.1 T0.002
11 L Z+0 R0 FMAX M91
12 ; operation: counterbore: bore
13 CYCL DEF 32.0 TOLERANCE
14 CYCL DEF 32.1 T0.02
15 TOOL CALL 24 Z S11671
16 M3
17 L X-1.956 Y+0 R0 FMAX
18 L Z+5 R0 FMAX
19 M8
20 L Z+1 R0 FMAX
21 L Z-3 F1750
22 CC X+0.482 Y+0
23 C X+2.92 Y+0 DR+ F863
24 CC X+0 Y+0
25 C X-2.92 Y+0 DR+
26 CC X+0 Y+0
27 C X+2.92 Y+0 DR+
28 L X-2.895 F1750
29 CC X+0.482 Y+0
30 C X+3.86 Y+0 DR+ F985
31 CC X+0 Y+0
32 C X-3.86 Y+0 DR+
33 CC X+0 Y+0
34 C X+3.86 Y+0 DR+
35 L X-3.835 F1750
36 CC X+0.482 Y+0
37 C X+4.8 Y+0 DR+ F1077
38 CC X+0 Y+0
39 C X-4.8 Y+0 DR+
40 CC X+0 Y+0
41 C X+4.8 Y+0 DR+
42 L Z+5 R0 FMAX
43 ; operation: counterbore: finish
44 CYCL DEF 32.0 TOLERANCE
45 CYCL DEF 32.1 T0.002
46 L X+0 R0 FMAX
47 L Z+1 R0 FMAX
48 L Z-3 F3501
49 CC X+2.5 Y+0
50 C X+4.999 Y+0 DR+ F2188
51 CC X+0 Y+0
52 C X-4.999 Y+0 DR+
53 CC X+0 Y+0
54 C X+4.999 Y+0 DR+
55 CC X+2.5 Y+0
56 C X+0 Y+0 DR+
57 CC X+2.5 Y+0
58 C X+4.999 Y+0 DR+
59 CC X+0 Y+0
60 C X-4.999 Y+0 DR+
61 CC X+0 Y+0
62 C X+4.999 Y+0 DR+
63 CC X+2.5 Y+0
64 C X+0 Y+0 DR+
65 L Z+5 R0 FMAX
66 M9
67 M5
68 L Z+0 R0 FMAX M91
69 M30
70 END PGM second-side-underside MM
